// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A sweep in parts with equally many beams. Each part is cast as if all its beams were fired at
// once, when its middle one is. This is for sensors whose beams share a few poses, and for those
// whose beams lie in no plane, so that it is not known which of them can meet what moves. Casts
// nothing itself. Pure.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "sim/sensor/scanner.h"
#include "sim/time.h"
#include "sim/world/mover.h"

namespace scipd::sim {

/// The beams of part `i` of `count`, which is at most `beams`.
[[nodiscard]] Beams equal_part(std::size_t beams, std::size_t i, std::size_t count);

[[nodiscard]] constexpr std::size_t middle_of(const Beams& beams) {
    return beams.first + beams.count / 2;
}

/// Beams, and the time at which the world is as they see it.
struct TimedBeams {
    Beams beams;
    Time time{};
};

/// All parts, in order. There are as few as it takes so that nothing which moves evenly moves more
/// than a millimetre within a part, but at most `most`.
[[nodiscard]] std::vector<TimedBeams> equal_parts(
    std::size_t beams, std::size_t most, const std::function<Time(std::size_t beam)>& fired,
    std::span<const Mover> movers);

}  // namespace scipd::sim
