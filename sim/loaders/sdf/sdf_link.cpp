// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_link.h"

#include <utility>

#include "sim/loaders/file/xml_tree.h"
#include "sim/loaders/parts/part_names.h"
#include "sim/loaders/sdf/sdf_sensors.h"
#include "sim/loaders/sdf/sdf_surface.h"
#include "sim/text/quote.h"

namespace scipd::sim {

using tinyxml2::XMLElement;

std::string place_of(const XMLElement& element, const SdfSheet& sheet,
                     const std::vector<std::string>& outer, const std::string& name) {
    const std::string path = path_of(outer);
    return text_of(sheet.place(element)) + ": " + (path.empty() ? "" : path + "::") + name + ": ";
}

namespace {

bool is_shapeless(const SdfSurface& surface) {
    const auto* none = std::get_if<NoShape>(&surface.geometry);
    return none != nullptr && !none->is_meant;
}

}  // namespace

std::optional<SdfPart> LinkReader::read(const XMLElement& element, const SdfSheet& sheet,
                                        SensorFrames& sensors) {
    SdfPart link{SdfPart::Kind::link, attribute(element, "name"), sheet.place(element)};
    try {
        link.pose = SdfValues(element, sheet.dialect).pose();
    } catch (const UnreadableValue& value) {
        draft_.leave_out(place_of(element, sheet, names_, link.name) + value.what());
        return std::nullopt;
    }
    auto collisions = read_surfaces(element, link.name, "collision", sheet);
    auto visuals = read_surfaces(element, link.name, "visual", sheet);
    put_surfaces(std::move(visuals), std::move(collisions), geometry_, link);
    const bool is_second = !sensors.links.insert(link.name).second;
    for (const XMLElement& sensor : Children(element, "sensor")) {
        if (is_second) {
            warn_of_sensor(sensor, link.name, sheet, "its link is not the first of this name");
        } else if (link.name.empty()) {
            warn_of_sensor(sensor, link.name, sheet, "its link has no name");
        } else {
            read_sensor(sensor, link.name, sheet, sensors);
        }
    }
    return link;
}

std::vector<SdfSurface> LinkReader::read_surfaces(const XMLElement& link, const std::string& name,
                                                  const char* kind, const SdfSheet& sheet) {
    const bool is_wanted = std::string_view{kind} == seen_element(geometry_);
    std::vector<std::string> outer = names_;
    outer.push_back(name);
    std::vector<SdfSurface> surfaces;
    for (const XMLElement& element : Children(link, kind)) {
        const auto place = [&] {
            return place_of(element, sheet, outer, attribute(element, "name"));
        };
        try {
            SdfSurface surface = surface_of(element, sheet, [&](const std::string& what) {
                if (is_wanted) draft_.warn(place() + what + "; ignored");
            });
            // Gazebo shows nothing here either. Only <empty> is meant to be empty.
            if (is_shapeless(surface)) throw UnreadableValue("has no <geometry> with a shape");
            surfaces.push_back(std::move(surface));
        } catch (const UnreadableValue& value) {
            if (is_wanted) draft_.leave_out(place() + value.what());
        }
    }
    if (is_wanted) mend_names(surfaces, outer, kind, draft_);
    return surfaces;
}

void LinkReader::read_sensor(const XMLElement& sensor, const std::string& link,
                             const SdfSheet& sheet, SensorFrames& sensors) {
    auto frame = frame_of_sensor(sensor, link, sheet);
    if (frame && !sensors.names.insert(frame->name).second) {
        frame = refuse("is not the first of this name in its link");
    }
    if (!frame) return warn_of_sensor(sensor, link, sheet, frame.error().why);
    sensors.frames.push_back(std::move(*frame));
}

void LinkReader::warn_of_sensor(const XMLElement& sensor, const std::string& link,
                                const SdfSheet& sheet, const std::string& why) {
    // For sensors that are not lidars, scipd needs only the pose, so faults get no warning.
    if (!is_lidar(sensor)) return;
    draft_.warn(text_of(sheet.place(sensor)) + ": sensor " + quote(attribute(sensor, "name")) +
                " of link " + quote(link) + " of model " + quote(path_of(names_)) + ": " + why +
                no_scanner_there);
}

}  // namespace scipd::sim
