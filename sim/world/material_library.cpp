// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/material_library.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "sim/world/reflection.h"

namespace scipd::sim {
namespace {

constexpr std::string_view unnamed = "default";

double reflectance_at(const std::map<int, double>& by_wavelength, int wavelength_nm) {
    if (by_wavelength.empty()) return 0.0;
    const auto above = by_wavelength.lower_bound(wavelength_nm);
    if (above == by_wavelength.begin()) return above->second;
    const auto below = std::prev(above);
    if (above == by_wavelength.end()) return below->second;
    const double part =
        static_cast<double>(wavelength_nm - below->first) / (above->first - below->first);
    return std::lerp(below->second, above->second, part);
}

Surface surface_of(const MaterialOptics& optics, int wavelength_nm) {
    const double reflectance = reflectance_at(optics.reflectance, wavelength_nm);
    return {.diffuse = static_cast<float>(reflectance * (1.0 - optics.specular)),
            .specular = static_cast<float>(reflectance * optics.specular),
            .gloss = static_cast<float>(optics.gloss),
            .retro = static_cast<float>(optics.retro),
            .transmission = static_cast<float>(optics.transmission),
            .roughness = static_cast<float>(optics.roughness),
            .texture = static_cast<float>(optics.texture)};
}

/// Phong's exponent of a lobe as wide as that of the GGX surface of a renderer: its alpha is the
/// square of the roughness, Blinn's exponent 2 / alpha^2 - 2, and Phong's a quarter of that.
double gloss_of(double roughness) {
    constexpr double mirror = 1e5;
    const double alpha = roughness * roughness;
    return std::clamp((0.5 / (alpha * alpha)) - 0.5, 1.0, mirror);
}

Surface as_metal(Surface surface, double metalness, double roughness) {
    const auto share = static_cast<float>(metalness);
    const float reflectance = surface.diffuse + surface.specular;
    surface.diffuse = reflectance * (1.0F - share);
    surface.specular = reflectance * share;
    surface.gloss = static_cast<float>(gloss_of(roughness));
    return surface;
}

/// Some of the face is clear, as if it were of glass: 4 % of what falls on that are mirrored.
Surface as_clear(Surface surface, double transparency) {
    constexpr float mirrored = 0.04F;
    constexpr float pane = 1e6F;
    const auto clear = static_cast<float>(transparency);
    if (surface.specular == 0.0F) surface.gloss = pane;
    surface.diffuse *= 1.0F - clear;
    surface.retro *= 1.0F - clear;
    surface.specular = std::lerp(surface.specular, mirrored, clear);
    surface.transmission = std::lerp(surface.transmission, 1.0F - mirrored, clear);
    return surface;
}

Surface seen_as(Surface surface, const Appearance& appearance) {
    constexpr double usual_roughness = 0.5;  // SDF's
    if (appearance.metalness) {
        surface = as_metal(surface, *appearance.metalness,
                           appearance.roughness.value_or(usual_roughness));
    }
    return appearance.transparency ? as_clear(surface, *appearance.transparency) : surface;
}

/// Scales what the face scatters and mirrors to `share` of the light.
void reflect(Surface& surface, float share) {
    const float reflectance = surface.diffuse + surface.specular;
    if (reflectance > 0.0F) {
        surface.diffuse *= share / reflectance;
        surface.specular *= share / reflectance;
    } else {
        surface.diffuse = share;
    }
}

Surface as_bright_as(Surface surface, double laser_retro) {
    surface.retro = static_cast<float>(std::clamp((laser_retro - 1.0) / retro_gain(), 0.0, 1.0));
    reflect(surface, std::min(static_cast<float>(laser_retro), 1.0F - surface.retro));
    const float gone = surface.diffuse + surface.specular + surface.retro;
    surface.transmission = std::clamp(1.0F - gone, 0.0F, surface.transmission);
    return surface;
}

}  // namespace

std::string in_lower_case(std::string_view name) {
    std::string lower{name};
    std::ranges::transform(lower, lower.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return lower;
}

void MaterialLibrary::add(MaterialOptics material) {
    const std::string key = in_lower_case(material.name);
    const auto same = std::ranges::find_if(
        materials_, [&](const MaterialOptics& other) { return in_lower_case(other.name) == key; });
    const auto index = static_cast<std::size_t>(same - materials_.begin());
    index_of_[key] = index;
    for (const std::string& alias : material.aliases)
        index_of_[in_lower_case(alias)] = index;
    if (same == materials_.end()) {
        materials_.push_back(std::move(material));
    } else {
        *same = std::move(material);
    }
}

const MaterialOptics* MaterialLibrary::find(std::string_view name) const {
    const auto found = index_of_.find(in_lower_case(name));
    return found == index_of_.end() ? nullptr : &materials_[found->second];
}

Surface MaterialLibrary::surface(const Material& material, int wavelength_nm) const {
    const MaterialOptics* const plain = find(unnamed);
    const MaterialOptics* const known = find(material.name);
    Surface surface;
    if (known != nullptr && known != plain) {
        surface = surface_of(*known, wavelength_nm);
    } else {
        if (plain != nullptr) surface = surface_of(*plain, wavelength_nm);
        surface = seen_as(surface, material.appearance);
    }
    const double bright = material.laser_retro.value_or(0.0);
    return bright > 0.0 ? as_bright_as(surface, bright) : surface;
}

std::size_t MaterialLibrary::numbers() const {
    std::size_t count = 0;
    for (const MaterialOptics& material : materials_)
        count += material.numbers;
    return count;
}

std::size_t MaterialLibrary::assumed() const {
    std::size_t count = 0;
    for (const MaterialOptics& material : materials_)
        count += material.assumed;
    return count;
}

}  // namespace scipd::sim
