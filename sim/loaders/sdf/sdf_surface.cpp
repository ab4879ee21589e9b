// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_surface.h"

#include <utility>

#include "sim/loaders/file/xml_tree.h"
#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

using tinyxml2::XMLElement;

/// scipd's own material comes first; the one that Gazebo shows is the next best guess.
void read_material(const XMLElement& element, SdfSurface& surface) {
    surface.material = trimmed(text_of(element.FirstChildElement("scipd:material")));
    if (!surface.material.empty()) return;
    surface.material = trimmed(text_of(inside(element, {"material", "script", "name"})));
    surface.from_script = !surface.material.empty();
}

Appearance appearance_of(const XMLElement& visual, const SdfSheet& sheet) {
    const auto number = [](const std::optional<std::string>& text) {
        return text ? parse_number(trimmed(*text)) : std::nullopt;
    };
    const auto* metal = inside(visual, {"material", "pbr", "metal"});
    const SdfValues of_metal(metal == nullptr ? visual : *metal, sheet.dialect);
    const auto said = [&](const char* name) {
        return metal == nullptr ? std::nullopt : number(of_metal.text(name));
    };
    return as_said(number(SdfValues(visual, sheet.dialect).text("transparency")), said("metalness"),
                   said("roughness"));
}

void share_retro(const std::vector<SdfSurface>& collisions, std::vector<SdfSurface>& visuals) {
    std::optional<double> common;
    for (const SdfSurface& collision : collisions) {
        if (!collision.laser_retro) continue;
        if (common && *common != *collision.laser_retro) return;
        common = collision.laser_retro;
    }
    for (SdfSurface& visual : visuals) {
        if (!visual.laser_retro) visual.laser_retro = common;
    }
}

}  // namespace

SdfSurface surface_of(const XMLElement& element, const SdfSheet& sheet, const Ignored& ignored) {
    const SdfValues values(element, sheet.dialect);
    SdfSurface surface{attribute(element, "name"), sheet.place(element)};
    surface.pose = values.pose();
    if (const auto* geometry = element.FirstChildElement("geometry")) {
        surface.geometry = geometry_of(*geometry, sheet);
    }
    read_material(element, surface);
    try {
        surface.laser_retro = values.number("laser_retro");
    } catch (const UnreadableValue& value) {
        ignored(value.what());
    }
    if (std::string_view{element.Name()} == "visual") {
        surface.appearance = appearance_of(element, sheet);
    }
    return surface;
}

void put_surfaces(std::vector<SdfSurface> visuals, std::vector<SdfSurface> collisions,
                  SdfGeometry seen, SdfPart& link) {
    share_retro(collisions, visuals);
    if (seen == SdfGeometry::collision) std::swap(visuals, collisions);
    link.surfaces = std::move(visuals);
    link.has_unseen = !collisions.empty();
}

}  // namespace scipd::sim
