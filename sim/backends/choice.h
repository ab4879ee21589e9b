// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which backend casts a sensor's fans fastest on this machine and in this scene: all contenders
// cast them for a short time, and the fastest one that agrees with the first is taken. Of a sweep
// with so many poses that it would take long, only some are cast. Reads no clock: the time is
// handed in. Lives on the thread of the backends.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include "sim/backends/range_backend.h"
#include "sim/time.h"

namespace scipd::sim {

struct Choice {
    std::size_t contender = 0;
    /// For people: what each took for a fan, or why it is out of the question.
    std::string reason;
};

struct ChoiceLimits {
    /// Of all casts together. Looked at between two of them, and everybody casts one fan twice,
    /// whatever that takes.
    Time budget = std::chrono::milliseconds(500);
    /// Asked between two casts: nobody wants to know any more. The choice is the first then.
    std::function<bool()> ended;
};

/// `fans` are as the sensor casts them, all with as many different poses. At least one of each; the
/// first contender is the yardstick, and is kept unless another is clearly faster.
Choice choose(std::span<RangeBackend* const> contenders, std::span<const Fan> fans,
              const std::function<Time()>& now, const ChoiceLimits& limits = {});

}  // namespace scipd::sim
