// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_geometry.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <glm/geometric.hpp>

#include "sim/loaders/file/load_error.h"
#include "sim/loaders/file/xml_tree.h"
#include "sim/world/extrusion.h"
#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

using tinyxml2::XMLElement;

/// Triangulating the floor and the top may take time that grows with the square of this number.
constexpr std::size_t most_outline_points = 2000;

PlacedShape placed(Mesh mesh) {
    return {std::make_shared<const Mesh>(std::move(mesh)), {}};
}

PlacedShape box_of(const SdfValues& box) {
    const glm::dvec3 size_m = box.vector("size").value_or(glm::dvec3{1.0});
    check_sizes({size_m.x, size_m.y, size_m.z});
    return {Box{size_m}, {}};
}

PlacedShape sphere_of(const SdfValues& sphere) {
    const double radius_m = sphere.number("radius").value_or(1.0);
    check_sizes({radius_m});
    return {Sphere{radius_m}, {}};
}

struct Round {
    double radius_m;
    double length_m;
};

Round round_of(const SdfValues& values, double radius_m) {
    const Round round{values.number("radius").value_or(radius_m),
                      values.number("length").value_or(1.0)};
    check_sizes({round.radius_m, round.length_m});
    return round;
}

PlacedShape ellipsoid_of(const SdfValues& ellipsoid) {
    const glm::dvec3 radii_m = ellipsoid.vector("radii").value_or(glm::dvec3{1.0});
    check_sizes({radii_m.x, radii_m.y, radii_m.z});
    return placed(ellipsoid_mesh(radii_m));
}

/// The shortest turn from z to the normal, as in Gazebo: SDF does not say how a plane's edges lie
/// about its normal.
glm::dquat turn_from_z(const glm::dvec3& normal) {
    const double length = glm::length(normal);
    if (!(length > 0.0)) throw LoadError({"its <normal> is 0 0 0, which is no direction"});
    const double up = normal.z / length;
    if (up < -1.0 + 1e-12) return {0.0, 1.0, 0.0, 0.0};
    return glm::normalize(glm::dquat{1.0 + up, -normal.y / length, normal.x / length, 0.0});
}

PlacedShape plane_of(const SdfValues& plane, const XMLElement& element) {
    glm::dvec2 size_m{1.0};
    if (const auto* size = element.FirstChildElement("size")) size_m = plane_point_in(*size);
    check_sizes({size_m.x, size_m.y});
    const glm::dvec3 normal = plane.vector("normal").value_or(glm::dvec3{0.0, 0.0, 1.0});
    return {Plane{size_m}, {{}, turn_from_z(normal)}};
}

/// It encloses nothing.
bool is_line(const Outline& outline) {
    const auto from_first = [&](const glm::dvec2& point) { return point - outline.front(); };
    const glm::dvec2 along = from_first(std::ranges::max(
        outline, {}, [&](const glm::dvec2& point) { return glm::length(from_first(point)); }));
    return std::ranges::none_of(outline, [&](const glm::dvec2& point) {
        const glm::dvec2 to = from_first(point);
        return std::abs(along.x * to.y - along.y * to.x) > 1e-12 * glm::dot(along, along);
    });
}

Outline outline_of(const XMLElement& polyline) {
    Outline outline;
    for (const XMLElement& point : Children(polyline, "point")) {
        const glm::dvec2 at_m = plane_point_in(point);
        if (!plausible_position({at_m.x, at_m.y, 0.0})) {
            throw LoadError(
                {"every <point> of a <polyline> must be finite and at most 1e7 m away"});
        }
        outline.emplace_back(at_m.x, at_m.y);
    }
    if (outline.size() > 1 && outline.front() == outline.back()) outline.pop_back();
    if (outline.size() < 3) throw LoadError({"a <polyline> needs three <point>s at least"});
    if (is_line(outline)) throw LoadError({"all <point>s of a <polyline> lie on one line"});
    return outline;
}

/// As in Gazebo, all polylines of one geometry are one body with the height of the first.
PlacedShape polylines_of(const XMLElement& first, const SdfValues& values) {
    const double height_m = values.number("height").value_or(1.0);
    check_sizes({height_m});
    std::vector<Outline> outlines;
    std::size_t points = 0;
    for (const auto* polyline = &first; polyline != nullptr;
         polyline = polyline->NextSiblingElement("polyline")) {
        outlines.push_back(outline_of(*polyline));
        points += outlines.back().size();
    }
    if (points > most_outline_points) {
        throw LoadError({"has " + std::to_string(points) + " outline points, at most " +
                         std::to_string(most_outline_points) + " are read; make it a mesh"});
    }
    return placed(extrusion_mesh(outlines, height_m));
}

std::string uri_of(const SdfValues& values) {
    const auto uri = values.text("uri");
    return uri ? *uri : values.text("filename").value_or("");
}

NamedMesh mesh_of(const SdfValues& values, const XMLElement& element, const SdfSheet& sheet) {
    NamedMesh mesh{{uri_of(values), sheet.folder}, {}};
    mesh.view.scale = values.vector("scale").value_or(glm::dvec3{1.0});
    check_scale(mesh.view.scale);
    if (const auto* submesh = element.FirstChildElement("submesh")) {
        const SdfValues part(*submesh, sheet.dialect);
        mesh.view.submesh = part.text("name").value_or("");
        mesh.view.is_centred = part.truth("center").value_or(false);
    }
    return mesh;
}

NamedHeights heights_of(const SdfValues& values, const SdfSheet& sheet) {
    NamedHeights heights{{uri_of(values), sheet.folder}, {values.vector("size")}};
    heights.view.position_m = values.vector("pos").value_or(glm::dvec3{0.0});
    const double sampling = values.number("sampling").value_or(1.0);
    heights.view.sampling = static_cast<std::size_t>(std::clamp(sampling, 0.0, 1e6));
    return heights;
}

Geometry shape_of(const XMLElement& shape, const SdfSheet& sheet) {
    const std::string_view kind = shape.Name();
    const SdfValues values(shape, sheet.dialect);
    if (kind == "empty") return NoShape{true};
    if (kind == "box") return box_of(values);
    if (kind == "sphere") return sphere_of(values);
    if (kind == "ellipsoid") return ellipsoid_of(values);
    if (kind == "plane") return plane_of(values, shape);
    if (kind == "polyline") return polylines_of(shape, values);
    if (kind == "mesh") return mesh_of(values, shape, sheet);
    if (kind == "heightmap") return heights_of(values, sheet);
    if (kind == "cylinder") {
        const auto [radius_m, length_m] = round_of(values, 1.0);
        return PlacedShape{Cylinder{radius_m, length_m}, {}};
    }
    if (kind == "capsule") {
        const auto [radius_m, length_m] = round_of(values, 0.5);
        return placed(capsule_mesh(radius_m, length_m));
    }
    if (kind == "cone") {
        const auto [radius_m, length_m] = round_of(values, 1.0);
        return placed(cone_mesh(radius_m, length_m));
    }
    return UnknownShape{std::string{kind}};
}

}  // namespace

Geometry geometry_of(const XMLElement& geometry, const SdfSheet& sheet) {
    const auto* shape = geometry.FirstChildElement();
    if (shape == nullptr) return NoShape{};
    return read_or_why([&] { return shape_of(*shape, sheet); });
}

Geometry read_or_why(const std::function<Geometry()>& read) {
    try {
        return read();
    } catch (const UnreadableValue& value) {
        return Unread{value.what()};
    } catch (const LoadError& error) {
        return Unread{error.what()};
    }
}

void check_scale(const glm::dvec3& scale) {
    if (scale.x * scale.y * scale.z == 0.0)
        throw LoadError({"its <scale> has a 0, which leaves nothing of the mesh"});
}

void check_sizes(std::initializer_list<double> sizes_m) {
    const auto plausible = [](double size_m) { return size_m > 0.0 && size_m <= position_limit_m; };
    if (!std::ranges::all_of(sizes_m, plausible)) {
        throw LoadError({"every size must be above 0 and at most 1e7 m"});
    }
}

std::optional<Shape> scaled(const Shape& shape, const glm::dvec3& scale) {
    if (scale == glm::dvec3{1.0}) return shape;
    if (const auto* box = std::get_if<Box>(&shape)) {
        const auto size_m = box->size_m * scale;
        check_sizes({size_m.x, size_m.y, size_m.z});
        return Box{size_m};
    }
    if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
        const Cylinder larger{cylinder->radius_m * std::max(scale.x, scale.y),
                              cylinder->length_m * scale.z};
        check_sizes({larger.radius_m, larger.length_m});
        return larger;
    }
    if (const auto* sphere = std::get_if<Sphere>(&shape)) {
        const Sphere larger{sphere->radius_m * std::max({scale.x, scale.y, scale.z})};
        check_sizes({larger.radius_m});
        return larger;
    }
    return std::nullopt;
}

}  // namespace scipd::sim
