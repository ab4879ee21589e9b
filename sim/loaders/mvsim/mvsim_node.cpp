// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/mvsim/mvsim_node.h"

#include <numbers>
#include <stdexcept>

#include <glm/geometric.hpp>
#include <tinyxml2.h>

#include "sim/loaders/file/xml_tree.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"
#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

constexpr double radians = std::numbers::pi / 180.0;
constexpr std::size_t most_points = 10'000;

double number_in(const std::string& text, const char* what) {
    return numbers_in(text, 1, what).front();
}

}  // namespace

std::vector<double> numbers_in(const std::string& text, std::size_t count, const char* what) {
    if (const auto all = parse_numbers(text, count)) return *all;
    throw std::invalid_argument("<" + std::string(what) + "> wants " + std::to_string(count) +
                                (count == 1 ? " number, not " : " numbers, not ") + quote(text));
}

const tinyxml2::XMLElement* MvsimNode::find(const char* child) const {
    const auto* own = element_.FirstChildElement(child);
    return own != nullptr || class_ == nullptr ? own : class_->FirstChildElement(child);
}

std::string MvsimNode::own_text() const {
    return substituted(text_of(&element_), variables_);
}

std::string MvsimNode::attribute(const char* name) const {
    const char* value = element_.Attribute(name);
    return value == nullptr ? "" : substituted(value, variables_);
}

std::optional<std::string> MvsimNode::text(const char* child) const {
    const auto* found = find(child);
    if (found == nullptr) return std::nullopt;
    return substituted(text_of(found), variables_);
}

double MvsimNode::number(const char* child, double otherwise) const {
    const auto said = text(child);
    return said ? number_in(*said, child) : otherwise;
}

bool MvsimNode::is_on(const char* child) const {
    const auto said = text(child);
    return said && (said->find("true") != said->npos || said->find('1') != said->npos);
}

std::vector<glm::dvec2> MvsimNode::points() const {
    std::vector<glm::dvec2> points;
    const auto shape = child("shape");
    if (!shape) return points;
    for (const MvsimNode& point : shape->children("pt")) {
        const auto xy = numbers_in(point.own_text(), 2, "pt");
        points.emplace_back(xy[0], xy[1]);
        if (!plausible_position({points.back(), 0.0}))
            throw std::invalid_argument("<pt> must lie within 1e7 m");
        if (points.size() > most_points) throw std::invalid_argument("<shape> has too many points");
    }
    return points;
}

Pose MvsimNode::pose() const {
    glm::dvec3 xyz_m{0.0};
    glm::dvec3 rpy_rad{0.0};
    if (const auto flat = text("init_pose")) {
        const auto said = numbers_in(*flat, 3, "init_pose");
        xyz_m = {said[0], said[1], 0.0};
        rpy_rad.z = said[2] * radians;
    } else if (const auto whole = text("init_pose3d")) {
        const auto said = numbers_in(*whole, 6, "init_pose3d");
        xyz_m = {said[0], said[1], said[2]};
        rpy_rad = glm::dvec3{said[5], said[4], said[3]} * radians;
    }
    if (!plausible_position(xyz_m) || !(glm::length(rpy_rad) < 1e6))
        throw std::invalid_argument("stands more than 1e7 m from the origin, or turned too far");
    return pose_from_rpy(xyz_m, rpy_rad);
}

std::optional<MvsimNode> MvsimNode::child(const char* name) const {
    const auto* found = find(name);
    if (found == nullptr) return std::nullopt;
    return MvsimNode{*found, nullptr, file_, variables_};
}

std::vector<MvsimNode> MvsimNode::children(const char* name) const {
    std::vector<MvsimNode> all;
    for (const auto* at = element_.FirstChildElement(name); at != nullptr;
         at = at->NextSiblingElement(name)) {
        all.push_back({*at, nullptr, file_, variables_});
    }
    return all;
}

double MvsimNode::attribute_or_child(const char* name, double otherwise) const {
    if (const std::string said = attribute(name); !said.empty()) return number_in(said, name);
    return number(name, otherwise);
}

bool MvsimNode::has(const char* child) const {
    return find(child) != nullptr;
}

bool MvsimNode::has_children() const {
    return element_.FirstChildElement() != nullptr;
}

std::string MvsimNode::name() const {
    return element_.Name();
}

std::string MvsimNode::place() const {
    return file_.string() + ':' + std::to_string(element_.GetLineNum());
}

}  // namespace scipd::sim
