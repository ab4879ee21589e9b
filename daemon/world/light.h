// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is known of the materials of a world, what fills its air and who shines in it, and how a
// scene looks by that in the light of a scanner. Each world has its own; one thread.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/time.h"
#include "sim/world/lit_world.h"
#include "sim/world/material_library.h"
#include "sim/world/medium.h"
#include "sim/world/scene.h"

namespace scipd::daemon {

/// The light of a lamp at one instant, in W. A scanner is a lamp that turns to others: one whose
/// receiver looks at a lamp while the lamp shines at it measures the lamp's pulses and not its own.
struct LampBeam {
    glm::dvec3 from_m;
    glm::dvec3 direction;
    double half_width_rad = 0.0;
};

class Lamp {
  public:
    Lamp() = default;
    Lamp(const Lamp&) = delete;
    Lamp& operator=(const Lamp&) = delete;
    virtual ~Lamp() = default;

    /// Returns nullopt while it is dark.
    [[nodiscard]] virtual std::optional<LampBeam> shines(sim::Time time) const = 0;
};

/// All lamps of a world. Each adds and removes itself.
class Lamps {
  public:
    void add(const Lamp& lamp) { lamps_.push_back(&lamp); }
    void remove(const Lamp& lamp) { std::erase(lamps_, &lamp); }
    [[nodiscard]] const std::vector<const Lamp*>& all() const { return lamps_; }

  private:
    std::vector<const Lamp*> lamps_;
};

/// A receiver at one instant, in W, and what its beam met.
struct Gaze {
    glm::dvec3 from_m;
    glm::dvec3 direction;
    double half_width_rad = 0.0;
    double range_m = 0.0;
};

inline constexpr double window_radius_m = 0.03;  ///< of lamps and receivers
/// True if receiver and lamp are within each other's cone, with nothing between them.
[[nodiscard]] bool dazzles(const LampBeam& lamp, const Gaze& gaze);

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
