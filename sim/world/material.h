// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace scipd::sim {

/// Index into Scene::materials.
using MaterialId = std::uint32_t;

/// What a surface is made of, as far as a world says it: its name, under which a library of
/// materials may know more, and the laser_retro of SDF. No two of a scene are equal; the first is
/// always "default" and says nothing more.
struct Material {
    std::string name;
    /// A return strength in no unit that SDF defines: greater is brighter. Many worlds say nothing.
    std::optional<double> laser_retro = std::nullopt;

    bool operator==(const Material&) const = default;
};

}  // namespace scipd::sim
