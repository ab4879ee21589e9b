// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads numbers in elements that libsdformat 12 does not know and keeps as text. Any thread.
#pragma once

#include <string>

#include <glm/vec3.hpp>
#include <sdf/Element.hh>

namespace scipd::sim {

/// The number in a child of `parent`; `otherwise` if there is no child of this name. Throws
/// LoadError if it is not a number.
double number_of_child(sdf::Element& parent, const std::string& name, double otherwise);

/// The three numbers in an element. Throws LoadError.
glm::dvec3 vector_of(sdf::Element& element);

}  // namespace scipd::sim
