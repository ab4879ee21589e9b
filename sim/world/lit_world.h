// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A world in light of one wavelength: what each of its materials sends back, lets through
// or mirrors, and what fills its air. It never changes and is shared by the sensors of that
// wavelength; any thread.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "sim/world/material_library.h"
#include "sim/world/medium.h"
#include "sim/world/reflection.h"
#include "sim/world/scene.h"

namespace scipd::sim {

class LitWorld {
  public:
    /// `surfaces`: by MaterialId.
    LitWorld(std::span<const Surface> surfaces, std::vector<Medium> media);

    [[nodiscard]] const Reflection& of(MaterialId material) const { return materials_[material]; }
    [[nodiscard]] std::span<const Medium> media() const { return media_; }
    /// Whether anything lets light through or mirrors it, so that a ray does not end where it first
    /// meets something.
    [[nodiscard]] bool light_goes_on() const { return light_goes_on_; }

  private:
    std::vector<Reflection> materials_;
    std::vector<Medium> media_;
    bool light_goes_on_;
};

/// Whether light goes on at a material of this scene; no LitWorld need be made for that.
[[nodiscard]] bool light_goes_on(const Scene& scene, const MaterialLibrary& materials,
                                 int wavelength_nm);

using SharedLitWorld = std::shared_ptr<const LitWorld>;

/// A share of the light that is too small for anything behind to be seen, but for reflectors.
inline constexpr float least_share = 0.01F;

}  // namespace scipd::sim
