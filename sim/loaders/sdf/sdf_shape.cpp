// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_shape.h"

#include <algorithm>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

#include <sdf/Box.hh>
#include <sdf/Capsule.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Element.hh>
#include <sdf/Ellipsoid.hh>
#include <sdf/Plane.hh>
#include <sdf/Sphere.hh>

#include "sim/loaders/file/load_error.h"
#include "sim/loaders/sdf/sdf_numbers.h"
#include "sim/loaders/sdf/sdf_road.h"
#include "sim/world/extrusion.h"
#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

/// Triangulating the floor and the top may take time that grows with the square of this number.
constexpr std::size_t most_outline_points = 2000;

void check_sizes(std::initializer_list<double> sizes_m) {
    const auto plausible = [](double size_m) { return size_m > 0.0 && size_m <= position_limit_m; };
    if (!std::ranges::all_of(sizes_m, plausible)) {
        throw LoadError({"every size must be above 0 and at most 1e7 m"});
    }
}

PlacedShape placed(Mesh mesh) {
    return {std::make_shared<const Mesh>(std::move(mesh)), {}};
}

PlacedShape placed_box(const ignition::math::Vector3d& size) {
    check_sizes({size.X(), size.Y(), size.Z()});
    return {Box{{size.X(), size.Y(), size.Z()}}, {}};
}

PlacedShape placed_cylinder(const sdf::Cylinder& cylinder) {
    check_sizes({cylinder.Radius(), cylinder.Length()});
    return {Cylinder{cylinder.Radius(), cylinder.Length()}, {}};
}

PlacedShape placed_sphere(const sdf::Sphere& sphere) {
    check_sizes({sphere.Radius()});
    return {Sphere{sphere.Radius()}, {}};
}

PlacedShape placed_plane(const sdf::Plane& plane) {
    check_sizes({plane.Size().X(), plane.Size().Y()});
    // The shortest turn from z to the normal, as in Gazebo: SDF does not say how a plane's edges
    // lie about its normal.
    ignition::math::Quaterniond turn;
    turn.From2Axes(ignition::math::Vector3d::UnitZ, plane.Normal());
    return {Plane{{plane.Size().X(), plane.Size().Y()}},
            {{}, glm::dquat{turn.W(), turn.X(), turn.Y(), turn.Z()}}};
}

PlacedShape placed_capsule(const sdf::Capsule& capsule) {
    check_sizes({capsule.Radius(), capsule.Length()});
    return placed(capsule_mesh(capsule.Radius(), capsule.Length()));
}

PlacedShape placed_cone(sdf::Element& cone) {
    const double radius_m = number_of_child(cone, "radius", 1.0);
    const double length_m = number_of_child(cone, "length", 1.0);
    check_sizes({radius_m, length_m});
    return placed(cone_mesh(radius_m, length_m));
}

PlacedShape placed_ellipsoid(const ignition::math::Vector3d& radii) {
    check_sizes({radii.X(), radii.Y(), radii.Z()});
    return placed(ellipsoid_mesh({radii.X(), radii.Y(), radii.Z()}));
}

Outline outline_of(sdf::Element& polyline) {
    Outline outline;
    for (auto point = polyline.FindElement("point"); point;
         point = point->GetNextElement("point")) {
        const auto at = point->Get<ignition::math::Vector2d>();
        if (!plausible_position({at.X(), at.Y(), 0.0})) {
            throw LoadError(
                {"every <point> of a <polyline> must be finite and at most 1e7 m away"});
        }
        outline.emplace_back(at.X(), at.Y());
    }
    if (outline.size() > 1 && outline.front() == outline.back()) outline.pop_back();
    if (outline.size() < 3) throw LoadError({"a <polyline> needs three <point>s at least"});
    return outline;
}

/// libsdformat 12 has no class for polylines, only their elements. As in Gazebo, all polylines of
/// one geometry are one body with the height of the first.
PlacedShape placed_polylines(sdf::ElementPtr polyline) {
    const double height_m = polyline->Get<double>("height");
    check_sizes({height_m});
    std::vector<Outline> outlines;
    std::size_t points = 0;
    for (; polyline; polyline = polyline->GetNextElement("polyline")) {
        outlines.push_back(outline_of(*polyline));
        points += outlines.back().size();
    }
    if (points > most_outline_points) {
        throw LoadError({"has " + std::to_string(points) + " outline points, at most " +
                         std::to_string(most_outline_points) + " are read; make it a mesh"});
    }
    return placed(extrusion_mesh(outlines, height_m));
}

}  // namespace

std::optional<PlacedShape> primitive_of(const sdf::Geometry& geometry) {
    if (const auto* box = geometry.BoxShape()) return placed_box(box->Size());
    if (const auto* cylinder = geometry.CylinderShape()) return placed_cylinder(*cylinder);
    if (const auto* sphere = geometry.SphereShape()) return placed_sphere(*sphere);
    if (const auto* plane = geometry.PlaneShape()) return placed_plane(*plane);
    if (const auto* capsule = geometry.CapsuleShape()) return placed_capsule(*capsule);
    if (const auto* ellipsoid = geometry.EllipsoidShape()) {
        return placed_ellipsoid(ellipsoid->Radii());
    }
    const auto element = geometry.Element();
    if (!element) return {};
    if (element->HasElement("polyline")) return placed_polylines(element->GetElement("polyline"));
    if (const auto cone = element->FindElement("scipd:cone")) return placed_cone(*cone);
    if (const auto road = element->FindElement("scipd:road")) return placed_road(*road);
    return {};
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

std::string kind_of(const sdf::Geometry& geometry) {
    const auto element = geometry.Element();
    const auto kind = element ? element->GetFirstElement() : nullptr;
    return kind ? kind->GetName() : "empty";
}

}  // namespace scipd::sim
