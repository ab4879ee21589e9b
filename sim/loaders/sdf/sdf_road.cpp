// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Makes a strip of a <road>.
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sim/loaders/file/load_error.h"
#include "sim/loaders/file/xml_tree.h"
#include "sim/loaders/sdf/sdf_surface.h"
#include "sim/loaders/sdf/sdf_world.h"
#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

using tinyxml2::XMLElement;

/// Skips repeated points: a road has no direction between two equal points.
std::vector<glm::dvec3> points_of(const XMLElement& road) {
    std::vector<glm::dvec3> points_m;
    for (const XMLElement& point : Children(road, "point")) {
        const glm::dvec3 at_m = point_in(point);
        if (!plausible_position(at_m)) {
            throw LoadError({"every <point> of a <road> must be finite and at most 1e7 m away"});
        }
        if (points_m.empty() || points_m.back() != at_m) points_m.push_back(at_m);
    }
    return points_m;
}

/// The horizontal vector from the middle of a road to its left edge at this point, as in Gazebo
/// Classic 11 (gazebo/rendering/Road2d.cc). It is normal to the line from the previous to the next
/// point, and longer in a turn, unless the road goes almost straight on or back.
glm::dvec3 to_the_left_m(const std::vector<glm::dvec3>& points_m, std::size_t at, double width_m) {
    const glm::dvec3& before_m = points_m[at == 0 ? 0 : at - 1];
    const glm::dvec3& after_m = points_m[std::min(at + 1, points_m.size() - 1)];
    double widening = 1.0;
    if (at > 0 && at + 1 < points_m.size()) {
        const double turn = glm::dot(glm::normalize(before_m - points_m[at]),
                                     glm::normalize(after_m - points_m[at]));
        if (std::abs(turn) < 0.97) widening = 1.0 / std::sin(0.5 * std::acos(turn));
    }
    const glm::dvec3 along_m = after_m - before_m;
    const double left_rad = std::atan2(along_m.x, -along_m.y);
    return 0.5 * width_m * widening * glm::dvec3{std::cos(left_rad), std::sin(left_rad), 0.0};
}

Mesh strip_along(const std::vector<glm::dvec3>& points_m, double width_m) {
    Mesh mesh;
    for (std::size_t at = 0; at < points_m.size(); ++at) {
        const glm::dvec3 left_m = to_the_left_m(points_m, at, width_m);
        mesh.vertices_m.emplace_back(points_m[at] + left_m);
        mesh.vertices_m.emplace_back(points_m[at] - left_m);
        if (at == 0) continue;
        const auto here = static_cast<glm::uint>(2 * at);
        mesh.triangles.emplace_back(here - 2, here - 1, here);
        mesh.triangles.emplace_back(here - 1, here, here + 1);
    }
    return mesh;
}

PlacedShape strip_of(const XMLElement& road, const Dialect& dialect) {
    const double width_m = SdfValues(road, dialect).number("width").value_or(1.0);
    if (!(width_m > 0.0 && width_m <= position_limit_m)) {
        throw LoadError({"the <width> of a <road> must be above 0 and at most 1e7 m"});
    }
    auto points_m = points_of(road);
    if (points_m.size() < 2) throw LoadError({"a <road> needs two <point>s that differ"});
    // Points are relative to the first one: floats are coarse far out, for example in map
    // coordinates.
    const glm::dvec3 first_m = glm::round(points_m.front());
    for (glm::dvec3& point_m : points_m)
        point_m -= first_m;
    return {std::make_shared<const Mesh>(strip_along(points_m, width_m)), {first_m}};
}

}  // namespace

SdfPart road_of(const XMLElement& road, const SdfSheet& sheet) {
    // A road looks like a visual without a geometry.
    SdfSurface visual = surface_of(road, sheet, [](const std::string&) {});
    visual.name = "visual";
    visual.geometry = read_or_why([&] { return strip_of(road, sheet.dialect); });
    SdfPart link{SdfPart::Kind::link, "link", sheet.place(road)};
    link.surfaces.push_back(std::move(visual));
    SdfPart model{SdfPart::Kind::model, attribute(road, "name"), sheet.place(road)};
    model.is_static = true;
    model.is_road = true;
    model.parts.push_back(std::move(link));
    return model;
}

}  // namespace scipd::sim
