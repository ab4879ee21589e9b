// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/lane.h"

namespace scipd::daemon {
namespace {

/// Where large pictures of many cameras wait, one of each still does.
constexpr std::size_t most_bytes = std::size_t{64} << 20U;

}  // namespace

bool Lane::loses_next() {
    const std::size_t waiting = state_->waiting;
    const bool full = waiting >= state_->most || (waiting > 0 && *state_->load >= most_bytes);
    if (full) ++state_->lost;
    return full;
}

void Lane::post(std::size_t bytes, Call call) {
    ++state_->waiting;
    *state_->load += bytes;
    state_->way([state = state_, bytes, call = std::move(call)] {
        --state->waiting;
        *state->load -= bytes;
        call();
    });
}

}  // namespace scipd::daemon
