// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/scene_edit_request.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "daemon/config/media.h"
#include "daemon/world/base64.h"
#include "sim/loaders/mesh/mesh_file.h"
#include "sim/loaders/poses/pose_line.h"
#include "sim/loaders/poses/small_json.h"
#include "sim/text/likely_unit.h"
#include "sim/text/name.h"
#include "sim/text/quote.h"
#include "sim/world/reach.h"

namespace scipd::daemon {
namespace {

using sim::Expected;
using MediumJson = nlohmann::json;

/// Keys, values and ends of lists that the longest list of media has, and some.
constexpr int most_json_values = 64 * static_cast<int>(most_media);

std::optional<glm::dvec3> corner_in(const MediumJson& box, const char* key) {
    const auto found = box.find(key);
    if (found == box.end() || !found->is_array() || found->size() != 3) return std::nullopt;
    glm::dvec3 corner_m{};
    for (int axis = 0; axis < 3; ++axis) {
        const MediumJson& number = (*found)[static_cast<std::size_t>(axis)];
        if (!number.is_number()) return std::nullopt;
        corner_m[axis] = number.get<double>();
    }
    if (!sim::plausible_position(corner_m)) return std::nullopt;
    return corner_m;
}

Expected<> read_word(const MediumJson& value, const std::string& key, std::string& text) {
    if (!value.is_string() || value.get_ref<const std::string&>().empty())
        return sim::refuse(key, "must be a text that is not empty");
    text = value;
    return {};
}

Expected<> read_corners(const MediumJson& value, MediumRequest& request) {
    if (!value.is_object() || value.size() != 2)
        return sim::refuse("box", R"(must be {"from":[X,Y,Z],"to":[X,Y,Z]})");
    const auto from_m = corner_in(value, "from");
    const auto to_m = corner_in(value, "to");
    if (!from_m || !to_m)
        return sim::refuse("box", "must have from and to, three numbers within 1e7 m each");
    request.box_m = {*from_m, *to_m};
    return {};
}

Expected<> read_key(const std::string& key, const MediumJson& value, MediumRequest& request) {
    if (key == "kind") return read_word(value, key, request.kind);
    if (key == "name") return read_word(value, key, request.name);
    if (key == "box") return read_corners(value, request);
    if (std::ranges::find(medium_numbers(), key) == medium_numbers().end())
        return sim::refuse(sim::printable(key, 64), "is no key of a medium");
    if (!value.is_number()) return sim::refuse(key, "must be a number");
    request.numbers[key] = value.get<double>();
    return {};
}

Expected<MediumRequest> request_in(const MediumJson& object) {
    if (!object.is_object()) return sim::refuse(R"(must be an object such as {"kind":"fog",..})");
    MediumRequest request;
    for (const auto& [key, value] : object.items()) {
        if (const auto read = read_key(key, value, request); !read)
            return tl::unexpected(read.error());
    }
    return request;
}

/// "[2].visibility_m", or "[2]" for the whole of it.
sim::Fault placed(std::size_t index, const sim::Fault& fault) {
    const std::string field =
        "[" + std::to_string(index) + "]" + (fault.field.empty() ? "" : ".") + fault.field;
    return {field, field + " " + fault.why};
}

Expected<> add(const MediumJson& object, std::vector<sim::Medium>& media) {
    const auto request = request_in(object);
    if (!request) return tl::unexpected(request.error());
    std::optional<sim::Fault> first;
    add_medium(*request, media, [&](std::string_view key, const std::string& why) {
        if (!first) first = {std::string(key), why};
    });
    if (first) return tl::unexpected(*std::move(first));
    return {};
}

Json box_document(const sim::Medium& medium) {
    const glm::dvec3& low = medium.low_m;
    const glm::dvec3& high = medium.high_m;
    return {{"from", {low.x, low.y, low.z}}, {"to", {high.x, high.y, high.z}}};
}

Json medium_document(const sim::Medium& medium) {
    Json document{{"kind", medium.kind}, {"name", medium.name}};
    if (const auto key = amount_key(medium.kind); !key.empty()) {
        document[std::string(key)] = medium.amount;
    } else {
        document["extinction_per_m"] = medium.extinction_per_m;
        document["returns_per_m"] = medium.returns_per_m;
        document["brightness"] = medium.brightness;
    }
    if (std::isfinite(medium.low_m.x)) document["box"] = box_document(medium);
    return document;
}

}  // namespace

using sim::Expected;

namespace {

/// Not the Json of documents.h, which keeps the order of its keys.
using RequestJson = nlohmann::json;
using sim::refuse;

constexpr std::array<std::string_view, 1> world_keys{"file"};
constexpr std::array<std::string_view, 11> model_keys{
    "name",  "sdf",      "file", "mesh",   "mesh_data", "mesh_format",
    "scale", "material", "pose", "static", "replace"};
constexpr std::array<std::string_view, 2> material_keys{"material", "materials"};

/// "there is file", "there are name, sdf and pose".
std::string there_are(std::span<const std::string_view> keys) {
    std::string text{keys.front()};
    for (const auto key : keys.subspan(1))
        text += (key == keys.back() ? " and " : ", ") + std::string(key);
    return (keys.size() == 1 ? "there is " : "there are ") + text;
}

/// The object that a body is. Other keys than these are refused.
Expected<RequestJson> object_in(const std::string& body, std::span<const std::string_view> keys) {
    auto object = sim::parse_small_json(body);
    if (!object) return refuse("the body must be a JSON object: " + object.error().why);
    if (!object->is_object()) return refuse("the body must be a JSON object");
    for (const auto& [key, value] : object->items()) {
        if (std::ranges::find(keys, key) != keys.end()) continue;
        return refuse(sim::printable(key, 64),
                      "the key " + sim::quote(key) + " is unknown; " + there_are(keys));
    }
    return object;
}

/// Leaves the text as it is where the key is not there.
Expected<> read_text(const RequestJson& object, const std::string& key, std::string& text) {
    if (!object.contains(key)) return {};
    const RequestJson& value = object[key];
    if (!value.is_string() || value.get_ref<const std::string&>().empty())
        return refuse(key, key + " must be a text that is not empty");
    text = value;
    return {};
}

/// A text that things can be called by.
Expected<> read_name(const RequestJson& object, const std::string& key, std::string& name) {
    std::string text;
    return read_text(object, key, text).and_then([&]() -> Expected<> {
        if (text.empty()) return {};
        const auto checked = sim::check_name(text);
        if (!checked) return refuse(key, key + " " + checked.error().why);
        name = text;
        return {};
    });
}

Expected<> read_path(const RequestJson& object, const std::string& key,
                     std::filesystem::path& path) {
    std::string text;
    return read_text(object, key, text).and_then([&]() -> Expected<> {
        const auto is_control = [](unsigned char c) { return c < ' ' || c == 0x7f; };
        if (std::ranges::any_of(text, is_control))
            return refuse(key, key + " must have no control characters");
        path = text;
        return {};
    });
}

Expected<> read_switch(const RequestJson& object, const std::string& key,
                       std::optional<bool>& value) {
    if (!object.contains(key)) return {};
    if (!object[key].is_boolean()) return refuse(key, key + " must be true or false");
    value = object[key].get<bool>();
    return {};
}

Expected<> require(const RequestJson& object, const std::string& key) {
    if (!object.contains(key)) return refuse(key, key + " is missing");
    return {};
}

/// The three angles that a good pose line may have.
void warn_of_degrees(const RequestJson& pose, std::vector<std::string>& warnings) {
    if (!pose.contains("rpy")) return;
    if (const auto warning = sim::degrees_for_radians(pose["rpy"].get<std::array<double, 3>>()))
        warnings.push_back("pose.rpy: " + *warning);
}

/// In the words of a pose line, without name, time and velocity.
Expected<> read_pose(const RequestJson& object, AddModel& edit) {
    if (!object.contains("pose")) return {};
    const RequestJson& value = object["pose"];
    if (!value.is_object()) return refuse("pose", R"(pose must be {"xyz":[..],"rpy":[..]})");
    for (const char* key : {"robot", "model", "t", "v", "w"}) {
        if (value.contains(key)) return refuse("pose", "pose: has no " + std::string(key));
    }
    const auto line = sim::pose_line_in(value);
    if (!line) return refuse("pose", "pose: " + line.error().why);
    edit.placement.world_from_model = line->pose;
    warn_of_degrees(value, edit.warnings);
    return {};
}

Expected<> read_name(const RequestJson& object, std::string& name) {
    if (const auto given = require(object, "name"); !given) return given;
    if (const auto read = read_text(object, "name", name); !read) return read;
    if (const auto good = sim::check_name(name); !good)
        return refuse("name", "name " + good.error().why);
    return {};
}

Expected<> read_scale(const RequestJson& object, double& scale) {
    if (!object.contains("scale")) return {};
    if (!object["scale"].is_number()) return refuse("scale", "scale must be a number");
    scale = object["scale"];
    if (!(scale > 0.0 && scale <= 1e7))
        return refuse("scale", "scale must be above 0 and at most 1e7");
    return {};
}

/// Whether the keys that say what the model is made of go together.
Expected<> check_source(const RequestJson& object) {
    const int sources = object.contains("sdf") + object.contains("file") + object.contains("mesh") +
                        object.contains("mesh_data");
    if (sources != 1) return refuse("sdf", "one of sdf, file, mesh and mesh_data must be given");
    for (const char* key : {"scale", "material"}) {
        if (object.contains(key) && object.contains("sdf"))
            return refuse(key, std::string(key) + " goes with a mesh; a text has its own");
    }
    return {};
}

/// The bytes stay base64 until they are loaded.
Expected<> read_bytes(const RequestJson& object, AddModel& edit) {
    const bool has_data = object.contains("mesh_data");
    if (has_data != object.contains("mesh_format"))
        return refuse("mesh_format",
                      "mesh_format goes with mesh_data: how the name of the file "
                      "would end, such as stl");
    if (!has_data) return {};
    return read_text(object, "mesh_data", edit.mesh_data)
        .and_then([&] { return read_text(object, "mesh_format", edit.mesh_format); })
        .and_then([&]() -> Expected<> {
            if (!base64_decoded(edit.mesh_data))
                return refuse("mesh_data", "mesh_data must be base64, without line breaks");
            const bool is_word = std::ranges::all_of(edit.mesh_format, [](char c) {
                return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
            });
            if (!is_word || !sim::is_mesh_file("mesh." + edit.mesh_format))
                return refuse("mesh_format",
                              "mesh_format must be one of the meshes that scipd "
                              "reads, such as obj, stl, ply, dae, glb");
            return {};
        });
}

Expected<> read_source(const RequestJson& object, AddModel& edit) {
    return read_text(object, "sdf", edit.sdf)
        .and_then([&] { return read_path(object, "file", edit.file); })
        .and_then([&] { return read_path(object, "mesh", edit.mesh); })
        .and_then([&] { return read_bytes(object, edit); })
        .and_then([&] { return read_name(object, "material", edit.material); })
        .and_then([&] { return check_source(object); })
        .and_then([&] { return read_scale(object, edit.scale); });
}

Expected<AddModel> model_in(const RequestJson& object) {
    AddModel edit;
    std::optional<bool> is_static;
    std::optional<bool> replace;
    return read_name(object, edit.placement.name)
        .and_then([&] { return read_pose(object, edit); })
        .and_then([&] { return read_source(object, edit); })
        .and_then([&] { return read_switch(object, "static", is_static); })
        .and_then([&] { return read_switch(object, "replace", replace); })
        .map([&] {
            if (is_static) edit.placement.movable = !*is_static;
            edit.replace = replace.value_or(false);
            return std::move(edit);
        });
}

Expected<std::vector<std::string>> materials_in(const RequestJson& object) {
    const bool is_list = object.contains("materials");
    if (is_list == object.contains("material"))
        return refuse("material", "one of material and materials must be given");
    std::vector<std::string> materials(1);
    if (!is_list) return read_name(object, "material", materials[0]).map([&] { return materials; });
    const RequestJson& names = object["materials"];
    if (!names.is_array() || names.empty())
        return refuse("materials", "materials must be a list of names, one for each object");
    materials.resize(names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
        const RequestJson one{{"materials", names[i]}};
        if (const auto read = read_name(one, "materials", materials[i]); !read)
            return tl::unexpected(read.error());
    }
    return materials;
}

}  // namespace

Expected<LoadWorld> parse_load_world(const std::string& body) {
    return object_in(body, world_keys).and_then([](const RequestJson& object) {
        LoadWorld edit;
        return require(object, "file")
            .and_then([&] { return read_path(object, "file", edit.file); })
            .map([&] { return std::move(edit); });
    });
}

Expected<AddModel> parse_add_model(const std::string& body) {
    return object_in(body, model_keys).and_then(model_in);
}

Expected<SetMaterial> parse_set_material(const std::string& model, const std::string& body) {
    return object_in(body, material_keys).and_then([&](const RequestJson& object) {
        return materials_in(object).map([&](std::vector<std::string> materials) {
            return SetMaterial{model, std::move(materials)};
        });
    });
}

Expected<std::vector<sim::Medium>> parse_media(const std::string& body) {
    const auto list = sim::parse_small_json(body, most_json_values);
    if (!list) return sim::refuse("the body must be a list of media: " + list.error().why);
    if (!list->is_array() || list->size() > most_media)
        return sim::refuse("the body must be a list of at most " + std::to_string(most_media) +
                           " media");
    std::vector<sim::Medium> media;
    for (std::size_t i = 0; i < list->size(); ++i) {
        if (const auto added = add((*list)[i], media); !added)
            return tl::unexpected(placed(i, added.error()));
    }
    return media;
}

Json media_document(const std::vector<sim::Medium>& media) {
    Json list = Json::array();
    for (const sim::Medium& medium : media)
        list.push_back(medium_document(medium));
    return list;
}

}  // namespace scipd::daemon
