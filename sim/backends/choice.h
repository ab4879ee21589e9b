// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Finds out which backend casts a sensor's fans fastest on this machine and in this scene. All
// contenders cast the fans for a short time, and the fastest one that agrees with the first one is
// chosen. Where a sweep has so many poses that it would take long, only some of them are cast.
// Reads no clock: the time is handed in. Lives on the thread of the backends.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "sim/backends/range_backend.h"
#include "sim/time.h"

namespace scipd::sim {

struct Contender {
    std::string_view name;  ///< for people
    RangeBackend* backend;
};

struct Choice {
    std::size_t contender = 0;
    /// For people: how long each took for a fan, and who casts wrong ranges.
    std::string reason;
};

struct ChoiceLimits {
    /// For all casts together. It is checked between casts, and every contender casts one fan twice
    /// however long that takes.
    Time budget = std::chrono::milliseconds(500);
    /// Asked between casts. Where it answers true, nobody needs the result any more, and the first
    /// contender is chosen.
    std::function<bool()> ended;
};

/// `fans` are as the sensor casts them, and all have the same number of different poses. Needs at
/// least one fan and one contender. The first contender is the yardstick: it is chosen unless
/// another one is clearly faster.
Choice choose(std::span<const Contender> contenders, std::span<const Fan> fans,
              const std::function<Time()>& now, const ChoiceLimits& limits = {});

}  // namespace scipd::sim
