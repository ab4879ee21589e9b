// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A planar scanner's side of depth_cover.h.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "sim/backends/depth_cover.h"
#include "sim/backends/pixel_axis.h"

namespace scipd::sim {
namespace {

/// A strip costs by its triangles and hardly by its pixels, so even a scanner with few beams gets
/// as many as show what lies between them: 1024 in 90 degrees.
constexpr double coarsest_pitch = 1.5e-3;

/// Directions of one plane by their angle in it, from `zero` counter-clockwise about the normal.
struct PlanarFan {
    struct Beam {
        double angle_rad;
        std::uint32_t ray;
    };
    glm::dvec3 zero;
    glm::dvec3 left;
    glm::dvec3 up;
    std::vector<Beam> beams;  ///< by angle, beginning after the widest gap
};

PlanarFan planar_fan(std::span<const glm::vec3> directions, const glm::dvec3& up) {
    const glm::dvec3 first{directions.front()};
    const glm::dvec3 zero = glm::normalize(first - glm::dot(up, first) * up);
    PlanarFan fan{zero, glm::cross(up, zero), up, {}};
    for (std::uint32_t ray = 0; ray < directions.size(); ++ray) {
        const glm::dvec3 direction{directions[ray]};
        fan.beams.push_back(
            {std::atan2(glm::dot(fan.left, direction), glm::dot(fan.zero, direction)), ray});
    }
    std::ranges::sort(fan.beams, {}, &PlanarFan::Beam::angle_rad);
    std::size_t begin = 0;
    double widest_gap =
        fan.beams.front().angle_rad + 2.0 * std::numbers::pi - fan.beams.back().angle_rad;
    for (std::size_t i = 1; i < fan.beams.size(); ++i) {
        const double gap = fan.beams[i].angle_rad - fan.beams[i - 1].angle_rad;
        if (gap <= widest_gap) continue;
        widest_gap = gap;
        begin = i;
    }
    std::rotate(fan.beams.begin(), fan.beams.begin() + static_cast<std::ptrdiff_t>(begin),
                fan.beams.end());
    for (PlanarFan::Beam& beam : fan.beams) {
        if (beam.angle_rad < fan.beams.front().angle_rad) beam.angle_rad += 2.0 * std::numbers::pi;
    }
    return fan;
}

/// One pass over neighbouring beams of a plane: a strip of one row.
StripView planar_view(const PlanarFan& fan, std::span<const PlanarFan::Beam> beams,
                      std::span<const glm::vec3> directions, double oversample) {
    const double middle_rad = 0.5 * (beams.front().angle_rad + beams.back().angle_rad);
    Strip strip;
    strip.forward = std::cos(middle_rad) * fan.zero + std::sin(middle_rad) * fan.left;
    strip.left = std::cos(middle_rad) * fan.left - std::sin(middle_rad) * fan.zero;
    strip.up = fan.up;
    std::vector<std::uint32_t> rays;
    std::vector<double> tangents;
    for (const PlanarFan::Beam& beam : beams) {
        rays.push_back(beam.ray);
        tangents.push_back(std::tan(beam.angle_rad - middle_rad));
    }
    tangents = distinct(std::move(tangents));
    std::optional<PixelAxis> axis = even_axis(tangents, oversample, coarsest_pitch);
    if (!axis) {
        std::vector<double> gaps;
        for (std::size_t i = 1; i < beams.size(); ++i)
            gaps.push_back(beams[i].angle_rad - beams[i - 1].angle_rad);
        const double pitch =
            std::clamp(median(std::move(gaps)) / oversample, same_direction, coarsest_pitch);
        axis = dense_axis(tangents.front(), tangents.back(), pitch);
    }
    strip.first = {axis->first, 0.0};
    strip.pitch = glm::dvec2{axis->pitch};
    strip.size_px = {axis->count, 1};
    return view_through(strip, directions, rays);
}

}  // namespace

std::optional<glm::dvec3> normal_of_common_plane(std::span<const glm::vec3> directions) {
    const glm::dvec3 first{directions.front()};
    glm::dvec3 widest{0.0};
    for (const glm::vec3& direction : directions) {
        const glm::dvec3 across = glm::cross(first, glm::dvec3{direction});
        if (glm::dot(across, across) > glm::dot(widest, widest)) widest = across;
    }
    const double sine = glm::length(widest);
    glm::dvec3 normal = sine > same_direction ? widest / sine : level_normal_to(first);
    if (normal.z < 0.0) normal = -normal;
    for (const glm::vec3& direction : directions) {
        if (std::abs(glm::dot(normal, glm::dvec3{direction})) > same_direction) return std::nullopt;
    }
    return normal;
}

std::vector<StripView> cover_plane(std::span<const glm::vec3> directions, const glm::dvec3& up,
                                   const DepthOptions& options) {
    const PlanarFan fan = planar_fan(directions, up);
    const double from_rad = fan.beams.front().angle_rad;
    const double extent_rad = fan.beams.back().angle_rad - from_rad;
    const double passes =
        std::max(1.0, std::ceil(extent_rad / options.widest_pass_rad - same_direction));
    std::vector<StripView> views;
    auto begin = fan.beams.begin();
    for (double pass = 1; begin != fan.beams.end(); ++pass) {
        const auto end = std::find_if(begin, fan.beams.end(), [&](const PlanarFan::Beam& beam) {
            return pass < passes && beam.angle_rad > from_rad + extent_rad * pass / passes;
        });
        if (begin != end)
            views.push_back(planar_view(fan, {begin, end}, directions, options.oversample));
        begin = end;
    }
    return views;
}

}  // namespace scipd::sim
