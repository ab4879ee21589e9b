// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/depth.h"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "sim/backends/depth_device.h"
#include "sim/backends/depth_plan.h"
#include "sim/backends/depth_raster.h"
#include "sim/backends/depth_sampler.h"
#include "sim/backends/depth_triangles.h"

namespace scipd::sim {
namespace {

/// A sweep may be cast in parts, between which the world moves on.
constexpr std::size_t most_plans = 32;

class DepthBackend final : public RangeBackend {
  public:
    DepthBackend(SharedScene shared_scene, const DepthOptions& options)
        : RangeBackend(std::move(shared_scene)), options_(options), triangles_(scene()) {
        raster_.set_vertices(triangles_.vertices());
        draw_anything();
    }

    [[nodiscard]] bool binds_thread() const override { return true; }
    void leave_thread() override { raster_.context().release(); }

  private:
    void do_move(ModelId model, const Pose& world_from_model) override;
    void do_cast(const Fan& fan, std::span<Hit> hits) override;

    [[nodiscard]] Pose anchored(const Pose& world_from_thing) const {
        return {world_from_thing.translation_m - scene().anchor_m, world_from_thing.rotation};
    }
    void draw_anything();
    const DepthPlan& plan_for(const Fan& fan);
    void draw(const Fan& fan, std::span<const PlannedView> views, glm::ivec2 size_px);
    void look_up(const Fan& fan, const DepthPlan& plan, std::span<const PlannedView> views,
                 std::span<Hit> hits) const;

    DepthOptions options_;
    DepthTriangles triangles_;
    DepthRaster raster_{depth_context()};
    std::vector<DepthPlan> plans_;  ///< for the latest fans
    std::size_t replaced_ = 0;      ///< the latest plan that made room for another
    Picture picture_;

    // Kept only for their memory.
    std::vector<DrawnView> views_;
    std::vector<DrawnTriangle> drawn_;
};

/// Drivers translate shaders when they are first drawn with, which takes longer than a scan lasts.
void DepthBackend::draw_anything() {
    const auto some =
        triangles_.triangles().first(std::min<std::size_t>(1, triangles_.triangles().size()));
    const std::vector<DrawnView> view{{.size_px = {1, 1}, .triangle_count = some.size()}};
    raster_.draw(view, some, {1, 1});
    raster_.read(picture_);
}

void DepthBackend::do_move(ModelId model, const Pose& world_from_model) {
    const VertexRange moved = triangles_.move(model, anchored(world_from_model));
    if (moved.count == 0) return;  // a model without geometry
    raster_.replace_vertices(moved.first, triangles_.vertices().subspan(moved.first, moved.count));
}

void DepthBackend::do_cast(const Fan& fan, std::span<Hit> hits) {
    const DepthPlan& plan = plan_for(fan);
    for (const PlannedPicture& picture : plan.pictures()) {
        draw(fan, plan.views_of(picture), picture.size_px);
        look_up(fan, plan, plan.views_of(picture), hits);
    }
}

const DepthPlan& DepthBackend::plan_for(const Fan& fan) {
    const auto known =
        std::ranges::find_if(plans_, [&](const DepthPlan& plan) { return plan.fits(fan); });
    if (known != plans_.end()) return *known;
    if (plans_.size() < most_plans) return plans_.emplace_back(fan, options_);
    replaced_ = (replaced_ + 1) % most_plans;
    return plans_[replaced_] = DepthPlan(fan, options_);
}

void DepthBackend::draw(const Fan& fan, std::span<const PlannedView> views, glm::ivec2 size_px) {
    views_.clear();
    drawn_.clear();
    for (const PlannedView& view : views) {
        const Pose pose = anchored(fan.world_from_sensor[view.pose]);
        const std::size_t first = drawn_.size();
        triangles_.collect(Frustum(view.strip, pose), fan.unseen, drawn_);
        views_.push_back(drawn_view(view, pose, first, drawn_.size() - first));
    }
    raster_.draw(views_, drawn_, size_px);
    raster_.read(picture_);
}

void DepthBackend::look_up(const Fan& fan, const DepthPlan& plan,
                           std::span<const PlannedView> views, std::span<Hit> hits) const {
    for (const PlannedView& view : views) {
        DepthSampler sampler(scene(), triangles_, picture_, options_.between_pixels,
                             anchored(fan.world_from_sensor[view.pose]));
        sampler.sample(plan.looks_of(view), fan, hits);
    }
}

}  // namespace

std::string_view depth_description() {
    return "depth buffer through EGL and OpenGL 4.5, on a graphics device or the processor";
}

std::unique_ptr<RangeBackend> make_depth_backend(SharedScene scene, const DepthOptions& options) {
    return std::make_unique<DepthBackend>(std::move(scene), options);
}

}  // namespace scipd::sim
