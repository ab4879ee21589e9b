// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One complete scan in the words of the wire. A view: the caller keeps its arrays alive while it is
// used.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "protocol/uptime.h"

namespace scipd::protocol {

/// One turn of the mirror.
struct Turn {
    Uptime start{};  ///< the instant of step 0: what the time stamp of its scan says
};

inline constexpr int max_echoes = 3;

struct Echo {
    std::uint32_t distance = 0;
    std::uint32_t intensity = 0;
};

/// What came back at one step.
struct StepEchoes {
    std::array<Echo, max_echoes>
        echo{};  ///< near to far; where nothing came back, one that holds the model's code
    int count = 1;
};

struct ScanView {
    Turn turn;
    int first_step = 0;                        ///< the step of element 0
    std::span<const std::uint32_t> distance;   ///< mm, or one of the model's DistanceCodes
    std::span<const std::uint32_t> intensity;  ///< as many; 18 bits, relative, no unit
    std::span<const StepEchoes> echoes;  ///< as many; or empty: each step has the one echo above
};

}  // namespace scipd::protocol
