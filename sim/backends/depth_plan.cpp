// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/depth_plan.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/common.hpp>

#include "sim/backends/depth_cover.h"

namespace scipd::sim {
namespace {

/// Every device of OpenGL 4.5 draws larger ones, and 16 million pixels take 128 MiB.
constexpr glm::ivec2 largest_picture_px{4096, 4096};

/// A beam that comes so near to a pixel's centre looks at that pixel alone.
constexpr double on_pixel = 1e-3;

/// Where the pose changes, from the first beam on.
std::vector<std::uint32_t> run_begins(const Fan& fan) {
    if (fan.directions.empty()) return {};
    std::vector<std::uint32_t> begins{0};
    for (std::uint32_t i = 1; i < fan.world_from_sensor.size(); ++i) {
        if (fan.world_from_sensor[i] == fan.world_from_sensor[i - 1]) continue;
        begins.push_back(i * static_cast<std::uint32_t>(fan.directions_per_pose));
    }
    return begins;
}

/// Along one axis: the pixel before, and the share of the way to the next.
std::pair<std::uint32_t, float> split(double pixel) {
    const double nearest = std::round(pixel);
    if (std::abs(pixel - nearest) < on_pixel) return {static_cast<std::uint32_t>(nearest), 0.0F};
    const double before = std::floor(pixel);
    return {static_cast<std::uint32_t>(before), static_cast<float>(pixel - before)};
}

Look look_at(const Sample& sample, const glm::vec3& direction, const PlannedView& view,
             int width_px) {
    const auto [x, share_x] = split(sample.pixel.x);
    const auto [y, share_y] = split(sample.pixel.y);
    const auto column = static_cast<std::uint32_t>(view.corner_px.x) + x;
    const auto row = static_cast<std::uint32_t>(view.corner_px.y) + y;
    return {.ray = sample.ray,
            .pixel = row * static_cast<std::uint32_t>(width_px) + column,
            .share = {share_x, share_y},
            .cos_alpha = static_cast<float>(cos_alpha(view.strip, glm::dvec3{direction}))};
}

}  // namespace

DepthPlan::DepthPlan(const Fan& fan, const DepthOptions& options)
    : directions_(fan.directions.begin(), fan.directions.end()), run_begins_(run_begins(fan)) {
    std::vector<std::vector<Sample>> samples;
    for (std::size_t run = 0; run < run_begins_.size(); ++run) {
        const std::size_t begin = run_begins_[run];
        const std::size_t end =
            run + 1 < run_begins_.size() ? run_begins_[run + 1] : directions_.size();
        for (StripView& view : cover(fan.directions.subspan(begin, end - begin), options)) {
            for (Sample& sample : view.samples)
                sample.ray += static_cast<std::uint32_t>(begin);
            views_.push_back({.strip = view.strip, .pose = fan.pose_index(begin)});
            samples.push_back(std::move(view.samples));
        }
    }
    place_views();
    for (const PlannedPicture& picture : pictures_) {
        for (std::size_t i = picture.first_view; i < picture.first_view + picture.view_count; ++i) {
            views_[i].first_look = looks_.size();
            views_[i].look_count = samples[i].size();
            for (const Sample& sample : samples[i])
                looks_.push_back(
                    look_at(sample, directions_[sample.ray], views_[i], picture.size_px.x));
        }
    }
}

/// From left to right in shelves, each as high as its highest strip, until the picture is full.
void DepthPlan::place_views() {
    glm::ivec2 corner_px{0, 0};
    int shelf_px = 0;
    for (std::size_t i = 0; i < views_.size(); ++i) {
        const glm::ivec2 size_px = views_[i].strip.size_px;
        if (corner_px.x + size_px.x > largest_picture_px.x) {
            corner_px = {0, corner_px.y + shelf_px};
            shelf_px = 0;
        }
        if (pictures_.empty() || corner_px.y + size_px.y > largest_picture_px.y) {
            pictures_.push_back({.first_view = i});
            corner_px = {0, 0};
            shelf_px = 0;
        }
        PlannedPicture& picture = pictures_.back();
        views_[i].corner_px = corner_px;
        corner_px.x += size_px.x;
        shelf_px = std::max(shelf_px, size_px.y);
        picture.size_px = glm::max(picture.size_px, views_[i].corner_px + size_px);
        ++picture.view_count;
    }
}

bool DepthPlan::fits(const Fan& fan) const {
    return std::ranges::equal(directions_, fan.directions) && run_begins_ == run_begins(fan);
}

}  // namespace scipd::sim
