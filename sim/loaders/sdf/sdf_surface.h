// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a visual and a collision have in common for a scanner: where it is, what shape it has and
// what it is made of. Any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sdf/Element.hh>
#include <sdf/Geometry.hh>
#include <sdf/Link.hh>

#include "sim/loaders/sdf/sdf_options.h"

namespace scipd::sim {

/// Points into the link that it was taken from.
struct SdfSurface {
    std::string name;
    sdf::SemanticPose pose;
    const sdf::Geometry* geometry = nullptr;
    sdf::ElementPtr element;
    std::string material;  ///< empty where it says none
    std::optional<double> laser_retro;
};

/// Of the wanted kind. A visual without a laser_retro has that of the collisions of its link where
/// all that have one agree: Gazebo Classic reads it there, Gazebo Sim in the visual.
std::vector<SdfSurface> surfaces_of(const sdf::Link& link, SdfGeometry wanted);

}  // namespace scipd::sim
