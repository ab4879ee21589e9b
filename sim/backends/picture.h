// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace scipd::sim {

/// What was drawn, row by row.
struct Picture {
    static constexpr std::uint32_t nothing = ~0U;

    glm::ivec2 size_px{0, 0};
    std::vector<float> depth;
    std::vector<std::uint32_t> triangle;  ///< or `nothing`
};

}  // namespace scipd::sim
