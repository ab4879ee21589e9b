// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One element of an MVSim world during the walk through it: its values and those of its class, with
// the variables of that moment. Any thread; valid as long as its document.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "sim/loaders/mvsim/formula.h"
#include "sim/world/pose.h"

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace scipd::sim {

class MvsimNode {
  public:
    /// `of_class` may be null.
    MvsimNode(const tinyxml2::XMLElement& element, const tinyxml2::XMLElement* of_class,
              const std::filesystem::path& file, const Variables& variables)
        : element_(element), class_(of_class), file_(file), variables_(variables) {}

    // All of these throw std::invalid_argument for what cannot be read.

    [[nodiscard]] std::string attribute(const char* name) const;
    /// The text of a child; nothing if there is no such child.
    [[nodiscard]] std::optional<std::string> text(const char* child) const;
    [[nodiscard]] double number(const char* child, double otherwise) const;
    [[nodiscard]] bool is_on(const char* child) const;
    /// x and y of each `<pt>` of `<shape>`; empty if there is none.
    [[nodiscard]] std::vector<glm::dvec2> points() const;
    /// `<init_pose>` or `<init_pose3d>`, in degrees; the origin if there is neither.
    [[nodiscard]] Pose pose() const;
    /// The child, of the element itself or of its class.
    [[nodiscard]] std::optional<MvsimNode> child(const char* name) const;
    [[nodiscard]] std::vector<MvsimNode> children(const char* name) const;
    /// A number that a door or a window has as an attribute or as a child.
    [[nodiscard]] double attribute_or_child(const char* name, double otherwise) const;

    [[nodiscard]] bool has(const char* child) const;
    [[nodiscard]] bool has_children() const;
    [[nodiscard]] std::string name() const;
    /// FILE:LINE
    [[nodiscard]] std::string place() const;
    [[nodiscard]] std::filesystem::path beside(const std::string& path) const {
        return file_.parent_path() / path;
    }

  private:
    [[nodiscard]] const tinyxml2::XMLElement* find(const char* child) const;
    [[nodiscard]] std::string own_text() const;

    const tinyxml2::XMLElement& element_;
    const tinyxml2::XMLElement* class_;
    const std::filesystem::path& file_;
    const Variables& variables_;
};

/// Exactly `count` numbers, separated by blanks. Throws std::invalid_argument, which names `what`,
/// for any other text.
std::vector<double> numbers_in(const std::string& text, std::size_t count, const char* what);

}  // namespace scipd::sim
