// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_values.h"

#include <cstdio>
#include <numbers>
#include <tuple>

#include <glm/geometric.hpp>

#include "sim/loaders/file/xml_tree.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

using tinyxml2::XMLElement;

constexpr std::size_t longest_shown = 200;

[[noreturn]] void cannot_read(const char* name, std::string_view text, const std::string& wanted) {
    throw UnreadableValue(
        std::string{"its <"} + name + "> " +
        (text.empty() ? std::string{} : '\'' + printable(text, longest_shown) + "' ") +
        "cannot be read: write " + wanted);
}

std::vector<double> numbers_in(const char* name, std::string_view text, std::size_t count) {
    const auto numbers = parse_numbers(text, count);
    if (!numbers)
        cannot_read(
            name, text,
            count == 1 ? "a number" : std::to_string(count) + " numbers, with blanks between");
    return *numbers;
}

}  // namespace

Dialect dialect_of(const XMLElement& root) {
    int major = 1;
    int minor = 12;
    if (const char* text = root.Attribute("version")) {
        if (std::sscanf(text, "%d.%d", &major, &minor) != 2) return {};
    }
    const std::tuple version{major, minor};
    return {version < std::tuple{1, 3}, version < std::tuple{1, 7}};
}

std::optional<std::string> SdfValues::text(const char* name) const {
    if (const auto* child = element_.FirstChildElement(name)) return text_of(child);
    const char* value = dialect_.has_attributes ? element_.Attribute(name) : nullptr;
    return value == nullptr ? std::nullopt : std::optional<std::string>{value};
}

std::optional<double> SdfValues::number(const char* name) const {
    const auto value = text(name);
    return value ? std::optional{numbers_in(name, *value, 1)[0]} : std::nullopt;
}

std::optional<glm::dvec3> SdfValues::vector(const char* name) const {
    const auto value = text(name);
    if (!value) return std::nullopt;
    const auto n = numbers_in(name, *value, 3);
    return glm::dvec3{n[0], n[1], n[2]};
}

std::optional<bool> SdfValues::truth(const char* name) const {
    const auto value = text(name);
    if (!value) return std::nullopt;
    const std::string_view word = trimmed(*value);
    if (word == "1" || word == "true" || word == "True" || word == "TRUE") return true;
    if (word == "0" || word == "false" || word == "False" || word == "FALSE") return false;
    cannot_read(name, word, "true or false");
}

const XMLElement* SdfValues::pose_element() const {
    const auto* pose = element_.FirstChildElement("pose");
    return pose == nullptr && dialect_.has_attributes ? element_.FirstChildElement("origin") : pose;
}

GivenPose SdfValues::pose() const {
    const auto* element = pose_element();
    if (element == nullptr) return {};
    GivenPose given;
    given.relative_to = attribute(*element, "relative_to");
    if (given.relative_to.empty() && dialect_.has_frame_attribute) {
        given.relative_to = attribute(*element, "frame");
    }
    const bool is_origin = std::string_view{element->Name()} == "origin";
    const std::string text = is_origin ? attribute(*element, "pose") : text_of(element);
    if (trimmed(text).empty()) return given;
    const std::string format = attribute(*element, "rotation_format");
    const bool is_quaternion = format == "quat_xyzw";
    if (!format.empty() && !is_quaternion && format != "euler_rpy")
        throw UnreadableValue("its pose has the rotation_format " + quote(format) +
                              ", which must be euler_rpy or quat_xyzw");
    bool in_degrees = false;
    if (element->QueryBoolAttribute("degrees", &in_degrees) == tinyxml2::XML_WRONG_ATTRIBUTE_TYPE)
        throw UnreadableValue("its pose has degrees " + quote(attribute(*element, "degrees")) +
                              ", which must be true or false");
    const auto n = numbers_in("pose", text, is_quaternion ? 7 : 6);
    given.pose.translation_m = {n[0], n[1], n[2]};
    if (is_quaternion) {
        // One of length 0 turns nothing, as in libsdformat.
        const glm::dquat turn{n[6], n[3], n[4], n[5]};
        if (glm::length(turn) > 0.0) given.pose.rotation = glm::normalize(turn);
        return given;
    }
    const double unit_rad = in_degrees ? std::numbers::pi / 180.0 : 1.0;
    given.pose = pose_from_rpy(given.pose.translation_m, unit_rad * glm::dvec3{n[3], n[4], n[5]});
    return given;
}

glm::dvec2 plane_point_in(const XMLElement& element) {
    const auto n = numbers_in(element.Name(), text_of(&element), 2);
    return {n[0], n[1]};
}

glm::dvec3 point_in(const XMLElement& element) {
    const auto n = numbers_in(element.Name(), text_of(&element), 3);
    return {n[0], n[1], n[2]};
}

}  // namespace scipd::sim
