// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_reader.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "sim/loaders/file/load_error.h"
#include "sim/loaders/file/xml_tree.h"
#include "sim/loaders/parts/part_names.h"
#include "sim/loaders/sdf/sdf_world.h"
#include "sim/loaders/sdf/urdf.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

using tinyxml2::XMLElement;

/// Models within models take some of the stack.
constexpr std::size_t deepest_model = 200;
/// What a part takes in all, from here to the scene.
constexpr std::size_t bytes_of_part = 1000;

bool is(const XMLElement& element, std::string_view name) {
    return element.Name() == name;
}

/// Parts are large, and a vector that grows takes twice as much.
std::size_t count_of_parts(const XMLElement& element) {
    std::size_t count = 0;
    for (const XMLElement& child : Children(element))
        count += is_one_of(child, {"model", "link", "include", "frame", "joint"}) ? 1 : 0;
    return count;
}

/// Nobody can see it, nor name it.
bool is_bare(const SdfPart& part) {
    return part.name.empty() && part.surfaces.empty() && !part.has_unseen;
}

bool is_seen(const SdfPart& model) {
    return std::ranges::any_of(model.parts, [](const SdfPart& part) {
        return part.kind == SdfPart::Kind::link || part.kind == SdfPart::Kind::model;
    });
}

/// Reason for which a document without a world has no model either.
std::string why_no_model(const SdfDocument& document) {
    if (document.is_robot()) return "is a URDF without a <link>; give the robot one";
    const auto* model = document.root().FirstChildElement("model");
    if (model == nullptr || model->FirstChildElement("include") == nullptr)
        return "holds no <world>, and no <model> with a <link>";
    return "its model " + quote(attribute(*model, "name")) +
           " has no <link>, and none of its includes could be read";
}

}  // namespace

SdfTree SdfReader::read(const SdfSource& source) {
    source_ = source.file.string();
    const SdfDocument& document = documents_.open(source);
    open_ = {&document};
    const XMLElement& root = document.root();
    if (!document.is_robot() && root.FirstChildElement("world") != nullptr) {
        return read_world(root, document.sheet);
    }
    std::vector<SdfPart> alone;
    if (auto model = model_in(document, "")) {
        alone.push_back(std::move(*model));
    } else {
        draft_.refuse(source_ + ": " + why_no_model(document));
    }
    name_apart(alone);
    const std::string name = alone.empty() ? "" : alone.front().name;
    SdfTree tree{{SdfPart::Kind::world, name, document.sheet.place(root)}, {}};
    tree.root.parts = std::move(alone);
    return tree;
}

SdfTree SdfReader::read_world(const XMLElement& root, const SdfSheet& sheet) {
    const XMLElement& world = *root.FirstChildElement("world");
    SdfTree tree{{SdfPart::Kind::world, attribute(world, "name"), sheet.place(world)}, {}};
    if (world.NextSiblingElement("world") != nullptr) {
        draft_.warn(source_ + ": holds several worlds; only the first, '" + tree.root.name +
                    "', is used");
    }
    tree.state = state_of(world, *sheet.file, draft_);
    read_parts(world, sheet, tree.root);
    const auto* inserted = inside(world, {"state", "insertions"});
    if (inserted != nullptr) read_parts(*inserted, sheet, tree.root);
    name_apart(tree.root.parts);
    return tree;
}

std::optional<SdfPart> SdfReader::model_in(const SdfDocument& document, const std::string& name) {
    const XMLElement& root = document.root();
    if (document.is_robot()) return read_robot(root, document.sheet, name);
    const auto* first = root.FirstChildElement("model");
    if (first == nullptr) first = root.FirstChildElement("actor");
    if (first == nullptr) return std::nullopt;
    if (is(*first, "model") && first->NextSiblingElement("model") != nullptr) {
        draft_.warn(text_of(document.sheet.place(root)) +
                    ": holds several models outside a world; only the first is used");
    }
    return read_model(*first, document.sheet, name);
}

std::optional<SdfPart> SdfReader::read_robot(const XMLElement& robot, const SdfSheet& sheet,
                                             const std::string& name) {
    SdfPart model = robot_of(robot, sheet, options_.geometry, draft_);
    if (!name.empty()) model.name = name;
    for (const XMLElement& more : Children(robot, "gazebo")) {
        if (more.Attribute("reference") != nullptr) continue;
        read_static(more, sheet, model);
        read_own_pose(more, sheet, model);
    }
    names_.push_back(model.name);
    SensorFrames sensors;
    for (const auto& [link, sensor] : sensors_of_robot(robot))
        links_.read_sensor(*sensor, link, sheet, sensors);
    std::ranges::move(sensors.frames, std::back_inserter(model.parts));
    // Gazebo puts what stands in a <gazebo> without a reference into the model.
    for (const XMLElement& more : Children(robot, "gazebo")) {
        if (more.Attribute("reference") != nullptr) continue;
        read_parts(more, sheet, model);
    }
    name_apart(model.parts);
    names_.pop_back();
    return is_seen(model) ? std::optional(std::move(model)) : std::nullopt;
}

std::optional<SdfPart> SdfReader::read_model(const XMLElement& element, const SdfSheet& sheet,
                                             const std::string& name) {
    count_parts(1);
    SdfPart model{SdfPart::Kind::model, name.empty() ? attribute(element, "name") : name,
                  sheet.place(element)};
    const SdfValues values(element, sheet.dialect);
    const auto place = [&] { return place_of(element, sheet, names_, model.name); };
    if (names_.size() >= deepest_model) {
        draft_.leave_out(place() + "models lie in each other more than 200 deep");
        return std::nullopt;
    }
    if (is(element, "actor") && element.NoChildren()) {
        draft_.leave_out(place() + "an <actor> that holds nothing is nobody");
        return std::nullopt;
    }
    read_static(element, sheet, model);
    try {
        if (is(element, "actor")) read_actor(element, sheet, model);
        if (!is(element, "actor")) model.pose = values.pose();
    } catch (const UnreadableValue& value) {
        draft_.leave_out(place() + value.what());
        return std::nullopt;
    }
    model.placement_frame = attribute(element, "placement_frame");
    model.canonical_link = attribute(element, "canonical_link");
    names_.push_back(model.name);
    read_parts(element, sheet, model);
    name_apart(model.parts);
    names_.pop_back();
    // Nobody would see a model without links.
    return is_seen(model) ? std::optional(std::move(model)) : std::nullopt;
}

/// A pose of a robot that cannot be read leaves it where it is.
void SdfReader::read_own_pose(const XMLElement& element, const SdfSheet& sheet, SdfPart& robot) {
    try {
        const SdfValues values(element, sheet.dialect);
        if (values.has_pose()) robot.pose = values.pose();
    } catch (const UnreadableValue& value) {
        draft_.warn(place_of(element, sheet, names_, robot.name) + value.what() + "; ignored");
    }
}

void SdfReader::read_static(const XMLElement& element, const SdfSheet& sheet, SdfPart& model) {
    try {
        const auto is_static = SdfValues(element, sheet.dialect).truth("static");
        if (is_static) model.is_static = is_static;
    } catch (const UnreadableValue& value) {
        draft_.warn(place_of(element, sheet, names_, model.name) + value.what() + "; ignored");
    }
}

void SdfReader::read_actor(const XMLElement& element, const SdfSheet& sheet, SdfPart& model) {
    const auto actor = std::make_shared<const Actor>(actor_of(element, sheet, draft_));
    model.pose.pose = actor->pose;
    if (actor->skin) model.parts.push_back(as_seen(skin_link_of(*actor, model.place)));
    model.actor = actor;
}

/// A link of visuals, as scanners see it.
SdfPart SdfReader::as_seen(SdfPart link) const {
    if (options_.geometry == SdfGeometry::visual) return link;
    link.surfaces.clear();
    link.has_unseen = true;
    return link;
}

void SdfReader::read_parts(const XMLElement& element, const SdfSheet& sheet, SdfPart& outer) {
    SensorFrames sensors;
    outer.parts.reserve(outer.parts.size() + count_of_parts(element));
    for (const XMLElement& child : Children(element))
        read_part(child, sheet, outer, sensors);
    std::ranges::move(sensors.frames, std::back_inserter(outer.parts));
}

void SdfReader::read_part(const XMLElement& element, const SdfSheet& sheet, SdfPart& outer,
                          SensorFrames& sensors) {
    const bool in_world = outer.kind == SdfPart::Kind::world;
    if (is(element, "model") || (in_world && is(element, "actor"))) {
        if (auto model = read_model(element, sheet, "")) outer.parts.push_back(std::move(*model));
    } else if (is(element, "include")) {
        read_include(element, sheet, outer);
    } else if (is(element, "frame") || is(element, "joint")) {
        read_frame(element, sheet, outer);
    } else if (!in_world && is(element, "link")) {
        read_link(element, sheet, outer, sensors);
    } else if (in_world && is(element, "road")) {
        SdfPart road = road_of(element, sheet);
        road.parts.front() = as_seen(std::move(road.parts.front()));
        outer.parts.push_back(std::move(road));
    } else if (in_world && is(element, "population")) {
        read_population(element, sheet, outer);
    }
}

void SdfReader::read_link(const XMLElement& element, const SdfSheet& sheet, SdfPart& outer,
                          SensorFrames& sensors) {
    auto link = links_.read(element, sheet, sensors);
    if (!link || is_bare(*link)) return;
    count_parts(1 + link->surfaces.size());
    outer.parts.push_back(std::move(*link));
}

void SdfReader::read_population(const XMLElement& element, const SdfSheet& sheet, SdfPart& world) {
    const std::string place = place_of(element, sheet, names_, attribute(element, "name"));
    const auto* of_all = element.FirstChildElement("model");
    try {
        if (of_all == nullptr) throw UnreadableValue("has no <model>");
        const auto places_m = places_of_population(element, sheet.dialect);
        for (std::size_t i = 0; i < places_m.size(); ++i) {
            const std::string name = attribute(*of_all, "name") + "_clone_" + std::to_string(i);
            auto model = read_model(*of_all, sheet, name);
            if (!model) return;
            model->pose = {{places_m[i]}, {}};
            world.parts.push_back(std::move(*model));
        }
    } catch (const UnreadableValue& value) {
        draft_.leave_out(place + value.what());
    }
}

void SdfReader::read_frame(const XMLElement& element, const SdfSheet& sheet, SdfPart& outer) {
    count_parts(1);
    const bool is_joint = is(element, "joint");
    SdfPart frame{is_joint ? SdfPart::Kind::joint : SdfPart::Kind::frame,
                  attribute(element, "name"), sheet.place(element)};
    const SdfValues values(element, sheet.dialect);
    frame.attached_to = attribute(element, "attached_to");
    if (is_joint) {
        const auto* child = element.FirstChildElement("child");
        const bool is_old = child != nullptr && child->Attribute("link") != nullptr;
        frame.attached_to = is_old ? attribute(*child, "link") : text_of(child);
    }
    try {
        frame.pose = values.pose();
        if (!is_bare(frame)) outer.parts.push_back(std::move(frame));
    } catch (const UnreadableValue& value) {
        // Nobody mounts a scanner at a joint.
        if (!is_joint)
            draft_.leave_out(place_of(element, sheet, names_, frame.name) + value.what());
    }
}

void SdfReader::count_parts(std::size_t count) {
    parts_ += count;
    if (parts_ * bytes_of_part <= options_.most_memory_bytes) return;
    throw LoadError(
        {source_ + ": takes more than the " +
         std::to_string((options_.most_memory_bytes + 500'000) / 1'000'000) +
         " MB that are allowed, with all its includes; put parts that never move into one link or "
         "one mesh, or allow more by world_memory_mb under limits in the configuration"});
}

void SdfReader::name_apart(std::vector<SdfPart>& parts) {
    mend_names(parts, names_, draft_);
}

}  // namespace scipd::sim
