// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/lit_world.h"

#include <algorithm>
#include <utility>

namespace scipd::sim {

LitWorld::LitWorld(std::span<const Surface> surfaces, std::vector<Medium> media)
    : media_(std::move(media)) {
    materials_.reserve(surfaces.size());
    for (const Surface& surface : surfaces)
        materials_.emplace_back(surface);
    light_goes_on_ = std::ranges::any_of(materials_, [](const Reflection& material) {
        return material.surface().transmission >= least_share || material.mirrored() >= least_share;
    });
}

}  // namespace scipd::sim
