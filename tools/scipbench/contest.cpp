// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/contest.h"

namespace scipd::tools {

Contest::Contest(const sim::SharedScene& scene, sim::RangeBackend& rays, sim::RangeBackend* depth,
                 const Resolution& resolution)
    : rays_(rays),
      depth_(depth),
      directions_(resolution.directions()),
      hits_(directions_.size()),
      range_m_(directions_.size()),
      materials_(directions_.size()) {
    if (depth_ != nullptr) pixels_.emplace(scene, resolution.strip());
}

bool Contest::takes_part(Method method) const {
    const bool casts = method == Method::rays || method == Method::rays_with_material;
    return casts || depth_ != nullptr;
}

void Contest::scan(Method method, const sim::Pose& pose) {
    switch (method) {
        case Method::rays:
        case Method::rays_with_material:
            return cast_rays(pose, method == Method::rays_with_material);
        case Method::depth:
        case Method::depth_with_material:
            return draw(pose, method == Method::depth_with_material);
        case Method::exact:
            return depth_->cast({directions_, {&pose, 1}}, hits_);
    }
}

void Contest::cast_rays(const sim::Pose& pose, bool with_material) {
    rays_.cast({directions_, {&pose, 1}}, hits_);
    for (std::size_t i = 0; i < hits_.size(); ++i)
        range_m_[i] = hits_[i].range_m;
    if (!with_material) return;
    for (std::size_t i = 0; i < hits_.size(); ++i)
        materials_[i] = hits_[i].material;
}

void Contest::draw(const sim::Pose& pose, bool with_material) {
    pixels_->draw(pose);
    pixels_->read_depth();
    pixels_->find_ranges(range_m_);
    if (!with_material) return;
    pixels_->read_triangles();
    pixels_->find_materials(materials_);
}

}  // namespace scipd::tools
