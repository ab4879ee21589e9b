// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads the roads of an SDF world: flat strips that Gazebo Classic draws along points. libsdformat
// 12 drops them. Any thread; nothing shared.
#pragma once

#include <sdf/Element.hh>

#include "sim/loaders/sdf/placed_shape.h"

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace scipd::sim {

/// Turns each <road> into a static model of the same name. Its one visual has a <scipd:road> as
/// geometry, with the unchanged width and points.
void put_roads_as_models(tinyxml2::XMLElement& world);

/// The strip of a <scipd:road>. Throws LoadError.
PlacedShape placed_road(sdf::Element& road);

}  // namespace scipd::sim
