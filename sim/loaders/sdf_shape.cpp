// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf_shape.h"

#include <sdf/Box.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Element.hh>
#include <sdf/Plane.hh>
#include <sdf/Sphere.hh>

namespace scipd::sim {
namespace {

bool sane(double length_m) {
    return length_m > 0.0 && length_m <= 1e7;
}

struct SizeCheck {
    bool operator()(const Box& box) const {
        return sane(box.size_m.x) && sane(box.size_m.y) && sane(box.size_m.z);
    }
    bool operator()(const Cylinder& cylinder) const {
        return sane(cylinder.radius_m) && sane(cylinder.length_m);
    }
    bool operator()(const Sphere& sphere) const { return sane(sphere.radius_m); }
    bool operator()(const Plane& plane) const {
        return sane(plane.size_m.x) && sane(plane.size_m.y);
    }
    bool operator()(const SharedMesh&) const { return true; }
};

PlacedShape placed_plane(const sdf::Plane& plane) {
    // The shortest turn from z to the normal: SDF does not say how a plane's edges lie about its
    // normal, Gazebo does it so.
    ignition::math::Quaterniond turn;
    turn.From2Axes(ignition::math::Vector3d::UnitZ, plane.Normal());
    return {Plane{{plane.Size().X(), plane.Size().Y()}},
            {{}, glm::dquat{turn.W(), turn.X(), turn.Y(), turn.Z()}}};
}

}  // namespace

std::optional<PlacedShape> primitive_of(const sdf::Geometry& geometry) {
    if (const auto* box = geometry.BoxShape()) {
        return PlacedShape{Box{{box->Size().X(), box->Size().Y(), box->Size().Z()}}, {}};
    }
    if (const auto* cylinder = geometry.CylinderShape()) {
        return PlacedShape{Cylinder{cylinder->Radius(), cylinder->Length()}, {}};
    }
    if (const auto* sphere = geometry.SphereShape()) {
        return PlacedShape{Sphere{sphere->Radius()}, {}};
    }
    if (const auto* plane = geometry.PlaneShape()) return placed_plane(*plane);
    return {};
}

std::string kind_of(const sdf::Geometry& geometry) {
    const auto element = geometry.Element();
    const auto kind = element ? element->GetFirstElement() : nullptr;
    return kind ? kind->GetName() : "empty";
}

bool has_sane_size(const Shape& shape) {
    return std::visit(SizeCheck{}, shape);
}

}  // namespace scipd::sim
