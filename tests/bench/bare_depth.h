// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The yardstick of the depth buffer: it draws pictures and reads them back, and nothing else. For
// each scan it works out beforehand where the views lie and which triangles they draw.
#pragma once

#include <span>
#include <vector>

#include "sim/backends/depth_device.h"
#include "sim/backends/depth_plan.h"
#include "sim/backends/depth_raster.h"
#include "sim/backends/depth_triangles.h"

namespace scipd::sim {

class BareDepth {
  public:
    enum class Drawn {
        seen,   ///< the triangles that the views of a scan can show
        whole,  ///< the whole scene, in each view
    };

    /// `scans` has the poses of each scan. Each view takes one of them.
    BareDepth(const Scene& scene, std::span<const PlannedView> views, glm::ivec2 size_px,
              const std::vector<std::vector<Pose>>& scans, Drawn what)
        : triangles_(scene), size_px_(size_px) {
        raster_.set_vertices(triangles_.vertices());
        for (const std::vector<Pose>& poses : scans) {
            Scan& scan = scans_.emplace_back();
            for (const PlannedView& view : views) {
                Pose pose = poses[view.pose];
                pose.translation_m -= scene.anchor_m;
                const std::size_t first = scan.drawn.size();
                if (what == Drawn::whole) {
                    const auto all = triangles_.triangles();
                    scan.drawn.insert(scan.drawn.end(), all.begin(), all.end());
                } else {
                    triangles_.collect(Frustum(view.strip, pose), no_model, scan.drawn);
                }
                scan.views.push_back(drawn_view(view, pose, first, scan.drawn.size() - first));
            }
        }
    }

    /// Returns when the picture is complete.
    void draw(std::size_t scan) {
        raster_.draw(scans_[scan].views, scans_[scan].drawn, size_px_);
        raster_.finish();
    }
    void read_depth() { raster_.read_depth(picture_); }
    void read_triangles() { raster_.read_triangles(picture_); }

    /// Draws and reads what a cast does.
    void draw_and_read(std::size_t scan) {
        raster_.draw(scans_[scan].views, scans_[scan].drawn, size_px_);
        raster_.read(picture_);
    }

    [[nodiscard]] const Picture& picture() const { return picture_; }

  private:
    struct Scan {
        std::vector<DrawnView> views;
        std::vector<DrawnTriangle> drawn;
    };

    DepthTriangles triangles_;
    glm::ivec2 size_px_;
    DepthRaster raster_{depth_context()};
    std::vector<Scan> scans_;
    Picture picture_;
};

}  // namespace scipd::sim
