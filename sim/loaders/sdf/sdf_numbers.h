// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Numbers of elements that libsdformat 12 does not know: it carries them along as text. Any thread.
#pragma once

#include <string>

#include <glm/vec3.hpp>
#include <sdf/Element.hh>

namespace scipd::sim {

/// Throws LoadError where it is no number.
double number_of_child(sdf::Element& parent, const std::string& name, double otherwise);

/// Of an element that holds three. Throws LoadError.
glm::dvec3 vector_of(sdf::Element& element);

}  // namespace scipd::sim
