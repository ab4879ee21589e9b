// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_surface.h"

#include <sdf/Collision.hh>
#include <sdf/Material.hh>
#include <sdf/Visual.hh>

#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

std::string own_material(const sdf::ElementPtr& element) {
    if (!element || !element->HasElement("scipd:material")) return {};
    return element->GetElement("scipd:material")->Get<std::string>();
}

/// libsdformat 12 keeps the laser_retro of a collision only in its element.
std::optional<double> retro_of(const sdf::ElementPtr& element) {
    if (!element || !element->HasElement("laser_retro")) return std::nullopt;
    return element->Get<double>("laser_retro");
}

std::optional<double> own_number(const sdf::ElementPtr& element, const char* name) {
    if (!element || !element->HasElement(name)) return std::nullopt;
    return parse_number(trimmed(element->GetElement(name)->Get<std::string>()));
}

/// From where sdf_document.cpp has put it.
Appearance appearance_of(const sdf::ElementPtr& element) {
    return as_said(own_number(element, "scipd:transparency"),
                   own_number(element, "scipd:metalness"), own_number(element, "scipd:roughness"));
}

SdfSurface surface_of(const sdf::Collision& collision) {
    return {collision.Name(),    collision.SemanticPose(),          collision.Geom(),
            collision.Element(), own_material(collision.Element()), retro_of(collision.Element())};
}

SdfSurface surface_of(const sdf::Visual& visual) {
    SdfSurface surface{
        visual.Name(),    visual.SemanticPose(),          visual.Geom(),
        visual.Element(), own_material(visual.Element()), retro_of(visual.Element())};
    surface.appearance = appearance_of(visual.Element());
    // scipd's own material comes first; the one that Gazebo shows is the next best guess.
    if (surface.material.empty() && visual.Material() != nullptr) {
        surface.material = visual.Material()->ScriptName();
    }
    return surface;
}

std::optional<double> common_retro(const std::vector<SdfSurface>& surfaces) {
    std::optional<double> common;
    for (const SdfSurface& surface : surfaces) {
        if (!surface.laser_retro) continue;
        if (common && *common != *surface.laser_retro) return std::nullopt;
        common = surface.laser_retro;
    }
    return common;
}

}  // namespace

std::vector<SdfSurface> surfaces_of(const sdf::Link& link, SdfGeometry wanted) {
    std::vector<SdfSurface> collisions;
    for (std::uint64_t i = 0; i < link.CollisionCount(); ++i)
        collisions.push_back(surface_of(*link.CollisionByIndex(i)));
    if (wanted == SdfGeometry::collision) return collisions;

    const auto retro = common_retro(collisions);
    std::vector<SdfSurface> visuals;
    for (std::uint64_t i = 0; i < link.VisualCount(); ++i) {
        visuals.push_back(surface_of(*link.VisualByIndex(i)));
        if (!visuals.back().laser_retro) visuals.back().laser_retro = retro;
    }
    return visuals;
}

}  // namespace scipd::sim
