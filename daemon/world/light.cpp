// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/world/light.h"

#include <utility>

namespace scipd::daemon {

void Light::set_materials(sim::SharedMaterials materials) {
    materials_ = std::move(materials);
    lit_.clear();
}

void Light::set_media(std::vector<sim::Medium> media) {
    media_ = std::move(media);
    lit_.clear();
}

void Light::configure_media(const std::vector<sim::Medium>& media) {
    if (std::exchange(configured_media_, media) != media) set_media(media);
}

sim::SharedLitWorld Light::shine(const sim::SharedScene& scene, int wavelength_nm) {
    if (std::exchange(scene_, scene) != scene) lit_.clear();
    sim::SharedLitWorld& lit = lit_[wavelength_nm];
    if (lit) return lit;
    std::vector<sim::Surface> surfaces;
    for (const sim::Material& material : scene->materials)
        surfaces.push_back(materials_->surface(material, wavelength_nm));
    return lit = std::make_shared<const sim::LitWorld>(surfaces, media_);
}

}  // namespace scipd::daemon
