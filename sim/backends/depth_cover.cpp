// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/depth_cover.h"

#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace scipd::sim {

std::vector<StripView> cover(std::span<const glm::vec3> directions, const DepthOptions& options) {
    if (directions.empty()) return {};
    if (const auto up = normal_of_common_plane(directions))
        return cover_plane(directions, *up, options);
    return cover_solid(directions, options);
}

StripView view_through(const Strip& strip, std::span<const glm::vec3> directions,
                       std::span<const std::uint32_t> rays) {
    StripView view{strip, {}};
    view.samples.reserve(rays.size());
    const glm::dvec2 last{strip.size_px - 1};
    for (const std::uint32_t ray : rays) {
        const glm::dvec2 pixel = pixel_of(strip, glm::dvec3{directions[ray]});
        view.samples.push_back({ray, glm::clamp(pixel, glm::dvec2{0.0}, last)});
    }
    return view;
}

glm::dvec3 level_normal_to(const glm::dvec3& direction) {
    const bool upright = std::abs(direction.z) > 0.9;
    return glm::normalize(
        glm::cross(direction, upright ? glm::dvec3{1, 0, 0} : glm::dvec3{0, 0, 1}));
}

}  // namespace scipd::sim
