// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/reflection.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scipd::sim {
namespace {

/// From here on a lobe is narrower than the spot of a scanner, so that rays can stand for it.
constexpr float smooth_gloss = 500.0F;

double diffuse_share(const Surface& surface, double cosine, double sine) {
    const double s2 = double{surface.roughness} * surface.roughness;
    const double flat = 1.0 - 0.5 * s2 / (s2 + 0.33);
    const double rough = 0.45 * s2 / (s2 + 0.09);
    // cos t * tan t is sin t, which stays finite along the face.
    return surface.diffuse * (cosine * flat + rough * sine * sine);
}

double specular_share(const Surface& surface, double gloss, double cosine) {
    const double cos_twice = 2.0 * cosine * cosine - 1.0;
    if (surface.specular <= 0.0F || cos_twice <= 0.0) return 0.0;
    return surface.specular * 0.5 * (gloss + 2.0) * std::pow(cos_twice, gloss) * cosine;
}

}  // namespace

double retro_gain() {
    return std::numbers::pi / (2.0 * std::numbers::pi * (1.0 - std::cos(retro_cone_rad)));
}

double returned_share(const Surface& surface, double cos_incidence) {
    const double cosine = std::clamp(cos_incidence, 0.0, 1.0);
    const double sine = std::sqrt(1.0 - cosine * cosine);
    return diffuse_share(surface, cosine, sine) + specular_share(surface, surface.gloss, cosine) +
           surface.retro * retro_gain() * cosine;
}

Reflection::Reflection(const Surface& surface)
    : surface_(surface), smooth_(mirrored_share(surface) > 0.0F), table_{} {
    Surface scattering = surface;
    if (smooth_) scattering.specular = 0.0F;
    for (std::size_t i = 0; i <= intervals; ++i) {
        const double x = double(i) / double(intervals);
        table_[i] = static_cast<float>(returned_share(scattering, 1.0 - x * x));
    }
    table_[intervals + 1] = table_[intervals];
}

float Reflection::highlight(float cos_incidence, double blur_rad2) const {
    if (!smooth_) return 0.0F;
    const double gloss = highlight_gloss(surface_.gloss, blur_rad2);
    return static_cast<float>(
        specular_share(surface_, gloss, std::min(1.0, double{cos_incidence})));
}

float mirrored_share(const Surface& surface) {
    return surface.gloss >= smooth_gloss ? surface.specular : 0.0F;
}

}  // namespace scipd::sim
