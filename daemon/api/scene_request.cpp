// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/scene_request.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "sim/loaders/poses/small_json.h"
#include "sim/loaders/poses/trajectory.h"
#include "sim/text/name.h"
#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

using Json = nlohmann::json;

constexpr std::array<std::string_view, 1> world_keys{"file"};
constexpr std::array<std::string_view, 9> model_keys{
    "name", "sdf", "file", "mesh", "scale", "material", "pose", "static", "replace"};

/// Of an object with no other keys than these. Throws BodyFault, as all below do.
Json object_in(const std::string& body, std::span<const std::string_view> keys) {
    Json object;
    try {
        object = sim::parse_small_json(body);
    } catch (const std::runtime_error& error) {
        throw BodyFault{std::string("the body must be a JSON object: ") + error.what(), {}};
    }
    if (!object.is_object()) throw BodyFault{"the body must be a JSON object", {}};
    for (const auto& [key, value] : object.items()) {
        if (std::ranges::find(keys, key) != keys.end()) continue;
        std::string known;
        for (const auto name : keys)
            known += (known.empty() ? "" : ", ") + std::string(name);
        throw BodyFault{"the key " + sim::quote(key) + " is unknown; there are " + known,
                        sim::printable(key, 64)};
    }
    return object;
}

/// Empty where it is not there.
std::string text_at(const Json& object, const std::string& key) {
    if (!object.contains(key)) return {};
    const Json& value = object[key];
    if (value.is_string() && !value.get_ref<const std::string&>().empty()) return value;
    throw BodyFault{key + " must be a text that says something", key};
}

std::string required_text(const Json& object, const std::string& key) {
    if (!object.contains(key)) throw BodyFault{key + " is missing", key};
    return text_at(object, key);
}

std::optional<bool> switch_at(const Json& object, const std::string& key) {
    if (!object.contains(key)) return std::nullopt;
    if (object[key].is_boolean()) return object[key].get<bool>();
    throw BodyFault{key + " must be true or false", key};
}

/// In the words of a pose line, less its name, its time and its velocity.
std::optional<sim::Pose> pose_at(const Json& object) {
    if (!object.contains("pose")) return std::nullopt;
    const Json& value = object["pose"];
    if (!value.is_object()) throw BodyFault{R"(pose must be {"xyz":[..],"rpy":[..]})", "pose"};
    for (const char* key : {"robot", "model", "t", "v", "w"}) {
        if (value.contains(key)) throw BodyFault{"pose: has no " + std::string(key), "pose"};
    }
    const std::string line = value.dump(-1, ' ', false, Json::error_handler_t::replace);
    const auto parsed = sim::parse_pose_line(line);
    if (const auto* why = std::get_if<std::string>(&parsed)) {
        throw BodyFault{"pose: " + *why, "pose"};
    }
    return std::get<sim::PoseLine>(parsed).pose;
}

/// What it is made from.
void read_source(const Json& object, AddModel& edit) {
    edit.sdf = text_at(object, "sdf");
    edit.file = text_at(object, "file");
    edit.mesh = text_at(object, "mesh");
    edit.material = text_at(object, "material");
    if (object.contains("sdf") + object.contains("file") + object.contains("mesh") != 1) {
        throw BodyFault{"one of sdf, file and mesh must be given", "sdf"};
    }
    for (const char* key : {"scale", "material"}) {
        if (object.contains(key) && object.contains("sdf")) {
            throw BodyFault{std::string(key) + " goes with a mesh; a text has its own", key};
        }
    }
    if (object.contains("scale")) {
        if (!object["scale"].is_number()) throw BodyFault{"scale must be a number", "scale"};
        edit.scale = object["scale"];
    }
}

AddModel model_in(const Json& object) {
    AddModel edit;
    edit.placement = {required_text(object, "name"), pose_at(object)};
    const std::string fault = sim::name_fault(edit.placement.name);
    if (!fault.empty()) throw BodyFault{"name " + fault, "name"};
    read_source(object, edit);
    if (const auto is_static = switch_at(object, "static")) edit.placement.movable = !*is_static;
    edit.replace = switch_at(object, "replace").value_or(false);
    return edit;
}

}  // namespace

std::variant<LoadWorld, BodyFault> parse_load_world(const std::string& body) {
    try {
        return LoadWorld{required_text(object_in(body, world_keys), "file")};
    } catch (BodyFault& fault) {
        return std::move(fault);
    }
}

std::variant<AddModel, BodyFault> parse_add_model(const std::string& body) {
    try {
        return model_in(object_in(body, model_keys));
    } catch (BodyFault& fault) {
        return std::move(fault);
    }
}

}  // namespace scipd::daemon
