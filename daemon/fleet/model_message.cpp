// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/fleet/model_message.h"

#include <nlohmann/json.hpp>

#include "daemon/api/scene_edit_request.h"

namespace scipd::daemon {

std::string text_of(const AddModel& edit) {
    nlohmann::ordered_json body{{"name", edit.placement.name}};
    if (!edit.sdf.empty()) body["sdf"] = edit.sdf;
    if (!edit.file.empty()) body["file"] = edit.file.string();
    if (!edit.mesh.empty()) body["mesh"] = edit.mesh.string();
    if (!edit.mesh_data.empty()) {
        body["mesh_data"] = edit.mesh_data;
        body["mesh_format"] = edit.mesh_format;
    }
    if (edit.scale != 1.0) body["scale"] = edit.scale;
    if (!edit.material.empty()) body["material"] = edit.material;
    if (const auto& pose = edit.placement.world_from_model) {
        const glm::dvec3& at_m = pose->translation_m;
        const glm::dquat& q = pose->rotation;
        body["pose"] = {{"xyz", {at_m.x, at_m.y, at_m.z}}, {"q", {q.x, q.y, q.z, q.w}}};
    }
    if (edit.placement.movable) body["static"] = !*edit.placement.movable;
    body["replace"] = true;
    return body.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

sim::Expected<SceneEdit> parse_model_message(const std::string& name, const std::string& text) {
    if (text.empty() || text == gone) return SceneEdit{RemoveModel{name}};
    return parse_add_model(text).and_then([&](AddModel edit) -> sim::Expected<SceneEdit> {
        if (edit.placement.name != name)
            return sim::refuse("name", "name must be the one of the topic");
        edit.replace = true;
        return SceneEdit{std::move(edit)};
    });
}

}  // namespace scipd::daemon
