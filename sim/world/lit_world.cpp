// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/lit_world.h"

#include <algorithm>
#include <utility>

namespace scipd::sim {
namespace {

bool passes_light(const Surface& surface) {
    return surface.transmission >= least_share || mirrored_share(surface) >= least_share;
}

}  // namespace

LitWorld::LitWorld(std::span<const Surface> surfaces, std::vector<Medium> media)
    : media_(std::move(media)) {
    materials_.reserve(surfaces.size());
    for (const Surface& surface : surfaces)
        materials_.emplace_back(surface);
    light_goes_on_ = std::ranges::any_of(surfaces, passes_light);
}

bool light_goes_on(const Scene& scene, const MaterialLibrary& materials, int wavelength_nm) {
    std::vector<bool> passes;
    for (const Material& material : scene.materials)
        passes.push_back(passes_light(materials.surface(material, wavelength_nm)));
    // A scene keeps materials of models that it has no more.
    return std::ranges::any_of(scene.objects,
                               [&](const Object& object) { return passes[object.material]; });
}

}  // namespace scipd::sim
