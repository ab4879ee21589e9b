// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The roads of an SDF world: flat strips that Gazebo Classic draws along points. libsdformat 12
// keeps nothing of them. Any thread; nothing shared.
#pragma once

#include <sdf/Element.hh>

#include "sim/loaders/sdf/placed_shape.h"

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace scipd::sim {

/// Each <road> becomes a static model of its name, whose one visual has a <scipd:road> for geometry
/// with the width and the points as they stood.
void put_roads_as_models(tinyxml2::XMLElement& world);

/// Throws LoadError.
PlacedShape placed_road(sdf::Element& road);

}  // namespace scipd::sim
