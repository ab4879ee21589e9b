// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/world/light.h"

#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

namespace scipd::daemon {
namespace {

/// True if `way` is within the cone around `direction`, which has unit length.
bool within(const glm::dvec3& way, const glm::dvec3& direction, double half_width_rad) {
    return glm::dot(way, direction) >= std::cos(half_width_rad) * glm::length(way);
}

}  // namespace

bool dazzles(const LampBeam& lamp, const Gaze& gaze) {
    const glm::dvec3 way = lamp.from_m - gaze.from_m;
    const double distance_m = glm::length(way);
    // A model of the scanner's housing may stand around its window: that of a UST is 5 cm wide.
    constexpr double housing_m = 0.04;
    if (distance_m < window_radius_m || distance_m > gaze.range_m + housing_m) return false;
    const double window_rad = std::atan2(window_radius_m, distance_m);
    return within(way, gaze.direction, gaze.half_width_rad + window_rad) &&
           within(-way, lamp.direction, lamp.half_width_rad + window_rad);
}

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
