// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The side of depth_cover.h for cameras, cones and everything else that is no plane.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sim/backends/depth_cover.h"
#include "sim/backends/pixel_axis.h"

namespace scipd::sim {
namespace {

using Rays = std::vector<std::uint32_t>;

/// Finer where directions are dense; vertices are rounded to a fraction of a pixel, which has to
/// stay small.
constexpr double coarsest_solid_pitch = 6e-2;

/// Along the longer side of a picture whose pixels are not where the directions are: what lies
/// between pixels is not known to it, so that a few beams of a wide cone would miss a pole that
/// they meet.
constexpr double least_pixels = 192.0;

/// Where a camera of no roll would look to have these directions in its middle.
Strip aimed(std::span<const glm::vec3> directions, const Rays& rays) {
    glm::dvec3 sum{0.0};
    for (const std::uint32_t ray : rays)
        sum += glm::dvec3{directions[ray]};
    Strip strip;
    if (glm::length(sum) < same_direction) return strip;
    sum = glm::normalize(sum);
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(sum[axis]) < 10.0 * same_direction) sum[axis] = 0.0;  // of a symmetric grid
    }
    strip.forward = glm::normalize(sum);
    strip.left = -level_normal_to(strip.forward);
    strip.up = glm::cross(strip.forward, strip.left);
    return strip;
}

/// The tangents of all directions in the frame of a strip; nothing where one of them lies too far
/// aside.
std::optional<std::array<std::vector<double>, 2>> tangents_in(const Strip& strip,
                                                              std::span<const glm::vec3> directions,
                                                              const Rays& rays, double widest) {
    std::array<std::vector<double>, 2> tangents;
    for (const std::uint32_t ray : rays) {
        const glm::dvec3 direction{directions[ray]};
        const double ahead = glm::dot(strip.forward, direction);
        const double left = glm::dot(strip.left, direction);
        const double up = glm::dot(strip.up, direction);
        const double most = ahead * widest * (1.0 + same_direction);
        if (ahead <= 0.0 || std::abs(left) > most || std::abs(up) > most) return std::nullopt;
        tangents[0].push_back(left / ahead);
        tangents[1].push_back(up / ahead);
    }
    return tangents;
}

/// How far apart pixels may be that show what these directions can tell apart: as far as the
/// directions are on average or in their order, where that is closer, as on the rings of a lidar.
double pitch_for(std::span<const glm::vec3> directions, const Rays& rays, double left_extent,
                 double up_extent) {
    constexpr double closer = 8.0;  // at most: 64 pixels a beam
    const auto count = double(rays.size());
    const double average = std::max(std::sqrt(left_extent * up_extent / count),
                                    std::max(left_extent, up_extent) / count);
    std::vector<double> steps;
    for (std::size_t i = 1; i < rays.size(); ++i)
        steps.push_back(double{glm::distance(directions[rays[i]], directions[rays[i - 1]])});
    return std::clamp(median(std::move(steps)), average / closer, average);
}

/// The pixels for one picture.
void lay_pixels(Strip& strip, std::array<std::vector<double>, 2> tangents,
                std::span<const glm::vec3> directions, const Rays& rays, double oversample) {
    for (std::vector<double>& axis : tangents)
        axis = distinct(std::move(axis));
    std::array<std::optional<PixelAxis>, 2> axes{
        even_axis(tangents[0], oversample, coarsest_solid_pitch),
        even_axis(tangents[1], oversample, coarsest_solid_pitch)};
    const double enough = 64.0 + 4.0 * oversample * oversample * double(rays.size());
    if (!axes[0] || !axes[1] || double(axes[0]->count) * axes[1]->count > enough) {
        const auto& [left, up] = tangents;
        const double width = left.back() - left.front();
        const double height = up.back() - up.front();
        const double coarsest =
            std::min(coarsest_solid_pitch, std::max(width, height) / least_pixels);
        const double pitch =
            std::max(same_direction,
                     std::min(pitch_for(directions, rays, width, height), coarsest) / oversample);
        axes = {dense_axis(left.front(), left.back(), pitch),
                dense_axis(up.front(), up.back(), pitch)};
    }
    strip.first = {axes[0]->first, axes[1]->first};
    strip.pitch = {axes[0]->pitch, axes[1]->pitch};
    strip.size_px = {axes[0]->count, axes[1]->count};
}

/// By the axis of S that a direction follows most: the faces of a cube around the eye.
std::vector<Rays> faces(std::span<const glm::vec3> directions, const Rays& rays) {
    std::vector<Rays> parts(6);
    for (const std::uint32_t ray : rays) {
        const glm::vec3 size = glm::abs(directions[ray]);
        int axis = size.y > size.x ? 1 : 0;
        if (size.z > size[axis]) axis = 2;
        parts[2 * axis + (directions[ray][axis] < 0.0F ? 1 : 0)].push_back(ray);
    }
    return parts;
}

/// Cut in the middle of the axis of S along which they differ most.
std::vector<Rays> halves(std::span<const glm::vec3> directions, const Rays& rays) {
    glm::vec3 low{2.0F};
    glm::vec3 high{-2.0F};
    for (const std::uint32_t ray : rays) {
        low = glm::min(low, directions[ray]);
        high = glm::max(high, directions[ray]);
    }
    const glm::vec3 side = high - low;
    int axis = side.y > side.x ? 1 : 0;
    if (side.z > side[axis]) axis = 2;
    const float middle = 0.5F * (low[axis] + high[axis]);
    std::vector<Rays> parts(2);
    for (const std::uint32_t ray : rays)
        parts[directions[ray][axis] < middle ? 0 : 1].push_back(ray);
    return parts;
}

void cover_part(std::span<const glm::vec3> directions, const Rays& rays,
                const DepthOptions& options, std::vector<StripView>& views) {
    if (rays.empty()) return;
    Strip strip = aimed(directions, rays);
    auto tangents = tangents_in(strip, directions, rays, std::tan(0.5 * options.widest_pass_rad));
    if (!tangents) {
        for (const Rays& half : halves(directions, rays))
            cover_part(directions, half, options, views);
        return;
    }
    lay_pixels(strip, std::move(*tangents), directions, rays, options.oversample);
    views.push_back(view_through(strip, directions, rays));
}

}  // namespace

std::vector<StripView> cover_solid(std::span<const glm::vec3> directions,
                                   const DepthOptions& options) {
    Rays all(directions.size());
    std::iota(all.begin(), all.end(), 0U);
    const double widest = std::tan(0.5 * options.widest_pass_rad);
    std::vector<StripView> views;
    if (tangents_in(aimed(directions, all), directions, all, widest)) {
        cover_part(directions, all, options, views);
    } else {
        for (const Rays& face : faces(directions, all))
            cover_part(directions, face, options, views);
    }
    return views;
}

}  // namespace scipd::sim
