// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/pixel_scan.h"

#include <array>
#include <utility>

#include <glm/geometric.hpp>

#include "sim/backends/depth_device.h"

namespace scipd::tools {

PixelScan::PixelScan(sim::SharedScene scene, const sim::Strip& strip)
    : scene_(std::move(scene)),
      triangles_(*scene_),
      view_{.strip = strip},
      raster_(sim::depth_context()) {
    raster_.set_vertices(triangles_.vertices());
    for (const sim::Face& face : triangles_.faces())
        material_of_.push_back(scene_->objects[face.object].material);
    for (int row = 0; row < strip.size_px.y; ++row) {
        for (int column = 0; column < strip.size_px.x; ++column) {
            const glm::dvec2 at = strip.first + strip.pitch * glm::dvec2{column, row};
            cos_alpha_.push_back(static_cast<float>(1.0 / glm::length(glm::dvec3{1.0, at})));
        }
    }
}

void PixelScan::draw(const sim::Pose& world_from_sensor) {
    const sim::Pose pose{world_from_sensor.translation_m - scene_->anchor_m,
                         world_from_sensor.rotation};
    drawn_.clear();
    triangles_.collect(sim::Frustum(view_.strip, pose), sim::no_model, drawn_);
    const std::array views{sim::drawn_view(view_, pose, 0, drawn_.size())};
    raster_.draw(views, drawn_, view_.strip.size_px);
    raster_.finish();
}

void PixelScan::find_ranges(std::span<float> range_m) const {
    constexpr auto near_plane_m = static_cast<float>(sim::near_m);
    for (std::size_t i = 0; i < range_m.size(); ++i)
        range_m[i] = near_plane_m / (picture_.depth[i] * cos_alpha_[i]);
}

void PixelScan::find_materials(std::span<sim::MaterialId> materials) const {
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const sim::TriangleId triangle = picture_.triangle[i];
        if (triangle != sim::Picture::nothing) materials[i] = material_of_[triangle];
    }
}

}  // namespace scipd::tools
