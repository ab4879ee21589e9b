// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The depth-buffer method of the paper: one picture, a pixel for each ray. Each step is a function
// of its own, so that it can be timed. The depth backend consists of the same parts. One thread.
#pragma once

#include <span>
#include <vector>

#include "sim/backends/depth_raster.h"
#include "sim/backends/depth_triangles.h"

namespace scipd::tools {

class PixelScan {
  public:
    /// Throws std::runtime_error if this machine cannot draw.
    PixelScan(sim::SharedScene scene, const sim::Strip& strip);

    /// Returns when the picture is complete.
    void draw(const sim::Pose& world_from_sensor);
    void read_depth() { raster_.read_depth(picture_); }
    void read_triangles() { raster_.read_triangles(picture_); }

    /// Computes the ranges from the depth that was read last; infinity if a pixel shows nothing.
    void find_ranges(std::span<float> range_m) const;
    /// Looks up the materials of the triangles that were read last.
    void find_materials(std::span<sim::MaterialId> materials) const;

  private:
    sim::SharedScene scene_;
    sim::DepthTriangles triangles_;
    sim::PlannedView view_;
    std::vector<float> cos_alpha_;
    std::vector<sim::MaterialId> material_of_;  ///< by triangle
    sim::DepthRaster raster_;
    sim::Picture picture_;
    std::vector<sim::DrawnTriangle> drawn_;
};

}  // namespace scipd::tools
