// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/scene_edit_request.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "daemon/world/base64.h"
#include "sim/loaders/mesh/mesh_file.h"
#include "sim/loaders/poses/pose_line.h"
#include "sim/loaders/poses/small_json.h"
#include "sim/text/likely_unit.h"
#include "sim/text/name.h"
#include "sim/text/quote.h"

namespace scipd::daemon {

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

}  // namespace scipd::daemon
