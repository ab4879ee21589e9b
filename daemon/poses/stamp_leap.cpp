// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/poses/stamp_leap.h"

#include <algorithm>

namespace scipd::daemon {
namespace {

// In floating point: stamps may lie farther apart than a Time can tell.
using Seconds = std::chrono::duration<double>;

// Long enough that nothing moves evenly across the leap: poses so far apart are no one movement.
constexpr Seconds long_enough{1.0};

}  // namespace

bool StampLeap::take(sim::Time stamp) {
    const Seconds step = Seconds(stamp) - Seconds(newest_);
    if (!first_ || step < -longest_back || step > longest_ahead) first_ = newest_ = stamp;
    newest_ = std::max(newest_, stamp);
    return Seconds(newest_) - Seconds(*first_) > long_enough;
}

}  // namespace scipd::daemon
