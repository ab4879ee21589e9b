// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace scipd::sim {

/// Index into Scene::materials.
using MaterialId = std::uint32_t;

/// What a file says of how a surface looks, in the words of renderers, each from 0 to 1. What is
/// not there is not said, or says no more than that would.
struct Appearance {
    std::optional<double> transparency = std::nullopt;  ///< 1 is clear
    std::optional<double> metalness = std::nullopt;     ///< 1 is bare metal
    std::optional<double> roughness = std::nullopt;     ///< of its highlights: 0 is a mirror

    bool operator==(const Appearance&) const = default;
};

/// The appearance that these numbers of a file mean. One out of bounds is taken as the bound. A NaN
/// says nothing, nor does a 0 except of roughness, which matters for metal alone.
Appearance as_said(std::optional<double> transparency, std::optional<double> metalness,
                   std::optional<double> roughness);

/// What a surface is made of, as far as a world says it: its name, under which a library of
/// materials may know more (material_library.h), the laser_retro of SDF, and its appearance. No two
/// of a scene are equal; the first is always "default" and says nothing more.
struct Material {
    std::string name;
    /// A return strength in no unit that SDF defines: greater is brighter. Many worlds say nothing.
    std::optional<double> laser_retro = std::nullopt;
    Appearance appearance = {};
    /// Its name is that of a material script, which Gazebo knows and scipd need not.
    bool from_script = false;

    bool operator==(const Material&) const = default;
};

}  // namespace scipd::sim
