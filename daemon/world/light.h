// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is known of the materials of a world, what fills its air and who shines in it, and how a
// scene looks by that in the light of a scanner. Each world has its own; one thread.
#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "daemon/world/lamps.h"
#include "sim/world/lit_world.h"
#include "sim/world/material_library.h"
#include "sim/world/medium.h"
#include "sim/world/scene.h"

namespace scipd::daemon {

class Light {
  public:
    /// From now on; nothing is known of materials before.
    void set_materials(sim::SharedMaterials materials);
    [[nodiscard]] const sim::SharedMaterials& materials() const { return materials_; }
    /// The media are these until somebody sets others.
    void set_media(std::vector<sim::Medium> media);
    /// What the configuration says of media. It takes the place of what somebody has set only where
    /// it is not what the configuration said before.
    void configure_media(const std::vector<sim::Medium>& media);
    [[nodiscard]] const std::vector<sim::Medium>& media() const { return media_; }

    /// The scanners that others may see.
    [[nodiscard]] Lamps& lamps() { return lamps_; }

    /// The scene in light of this wavelength.
    [[nodiscard]] sim::SharedLitWorld shine(const sim::SharedScene& scene, int wavelength_nm);

  private:
    sim::SharedMaterials materials_ = std::make_shared<const sim::MaterialLibrary>();
    std::vector<sim::Medium> media_;
    std::vector<sim::Medium> configured_media_;
    Lamps lamps_;
    sim::SharedScene scene_;                  ///< the latest that was lit
    std::map<int, sim::SharedLitWorld> lit_;  ///< that scene, by wavelength in nm
};

}  // namespace scipd::daemon
