// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads the values of SDF elements. What is there and cannot be read throws an UnreadableValue,
// whose text is the end of a sentence. Any thread; nothing shared.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <tinyxml2.h>

#include "sim/loaders/parts/part.h"

namespace scipd::sim {

struct UnreadableValue : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// How a version of SDF writes things.
struct Dialect {
    /// Up to 1.2, values may stand in attributes: <box size='1 1 1'/>, <origin pose='…'/>.
    bool has_attributes = false;
    /// Up to 1.6, `relative_to` is called `frame`.
    bool has_frame_attribute = false;
};

/// The dialect of an <sdf> or <gazebo>. Versions that are no number are like the newest.
Dialect dialect_of(const tinyxml2::XMLElement& root);

/// The values in the children of one element.
class SdfValues {
  public:
    SdfValues(const tinyxml2::XMLElement& element, const Dialect& dialect)
        : element_(element), dialect_(dialect) {}

    /// Nothing if there is no such child.
    [[nodiscard]] std::optional<std::string> text(const char* name) const;
    [[nodiscard]] std::optional<double> number(const char* name) const;
    [[nodiscard]] std::optional<glm::dvec3> vector(const char* name) const;
    [[nodiscard]] std::optional<bool> truth(const char* name) const;
    /// An element without a pose lies where it is by default.
    [[nodiscard]] GivenPose pose() const;
    [[nodiscard]] bool has_pose() const { return pose_element() != nullptr; }

  private:
    [[nodiscard]] const tinyxml2::XMLElement* pose_element() const;

    const tinyxml2::XMLElement& element_;
    const Dialect& dialect_;
};

/// The numbers in a <point> itself.
glm::dvec2 plane_point_in(const tinyxml2::XMLElement& element);
glm::dvec3 point_in(const tinyxml2::XMLElement& element);

}  // namespace scipd::sim
