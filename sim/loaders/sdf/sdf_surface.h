// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a scanner needs of a visual or a collision: its pose, its shape and its material. Any
// thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sdf/Element.hh>
#include <sdf/Geometry.hh>
#include <sdf/Link.hh>

#include "sim/loaders/sdf/sdf_options.h"
#include "sim/world/material.h"

namespace scipd::sim {

/// Points into a link, which must outlive it.
struct SdfSurface {
    std::string name;
    sdf::SemanticPose pose;
    const sdf::Geometry* geometry = nullptr;
    sdf::ElementPtr element;
    std::string material;  ///< empty: none given
    std::optional<double> laser_retro;
    Appearance appearance = {};  ///< of a visual
};

/// The surfaces of the wanted kind. A visual without a laser_retro gets that of its link's
/// collisions, if all that have one agree: Gazebo Classic reads it in the collision, Gazebo Sim in
/// the visual.
std::vector<SdfSurface> surfaces_of(const sdf::Link& link, SdfGeometry wanted);

}  // namespace scipd::sim
