// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is there: the scene, other scenes in its place, and models that come, go and move.
#include <optional>
#include <set>
#include <utility>

#include "daemon/api/documents.h"
#include "daemon/api/pose_routes.h"
#include "daemon/api/scene_edit_request.h"
#include "daemon/http/problem.h"
#include "daemon/models/best_fit.h"

namespace scipd::daemon {
namespace {

/// What each model consists of, by ModelId.
struct Content {
    std::size_t objects = 0;
    std::set<std::string> materials;
};

std::vector<Content> contents_of(const sim::Scene& scene) {
    std::vector<Content> contents(scene.models.size());
    for (const sim::Object& object : scene.objects) {
        Content& content = contents[object.model];
        ++content.objects;
        content.materials.insert(scene.materials[object.material].name);
    }
    return contents;
}

Json lidar_document(const Api& api, const sim::Scene& scene, const sim::Frame& frame) {
    const sim::Model& model = scene.models[frame.model];
    const auto now = api.model_pose(model.name);
    const sim::Pose world_from_model = now ? now->pose : model.world_from_model;
    const sim::Lidar& lidar = *frame.lidar;
    Json document{{"name", frame.name},
                  {"type", frame.sensor},
                  {"pose", pose_document(world_from_model * frame.model_from_frame)},
                  {"range_m", {lidar.min_range_m, lidar.max_range_m}},
                  {"angle_rad", {lidar.min_angle_rad, lidar.max_angle_rad}},
                  {"samples", lidar.samples},
                  {"rows", lidar.rows},
                  {"rate_hz", nullptr},
                  {"fits", best_fit(lidar).profile.name}};
    if (lidar.rate_hz > 0.0) document["rate_hz"] = lidar.rate_hz;
    return document;
}

Json scene_document(const Api& api, const SceneView& view) {
    const sim::Scene& scene = *view.scene;
    const std::vector<Content> contents = contents_of(scene);
    Json models = Json::array();
    Json materials = Json::array();
    for (std::size_t id = 0; id < scene.models.size(); ++id) {
        const sim::Model& model = scene.models[id];
        const auto now = api.model_pose(model.name);
        models.push_back({{"name", model.name},
                          {"movable", model.movable},
                          {"pose", pose_document(now ? now->pose : model.world_from_model)},
                          {"objects", contents[id].objects},
                          {"materials", contents[id].materials}});
    }
    for (const sim::Material& material : scene.materials)
        materials.push_back(material.name);
    Json sensors = Json::array();
    for (const sim::Frame& frame : scene.frames) {
        if (frame.lidar) sensors.push_back(lidar_document(api, scene, frame));
    }
    return {{"file", view.file},
            {"name", scene.name},
            {"models", models},
            {"materials", materials},
            {"sensors", sensors}};
}

int status_of(EditOutcome::Result result) {
    switch (result) {
        case EditOutcome::Result::forbidden:
            return 403;
        case EditOutcome::Result::unknown:
            return 404;
        case EditOutcome::Result::taken:
            return 409;
        case EditOutcome::Result::too_much:
            return 413;
        case EditOutcome::Result::not_now:
            return 503;
        default:
            return 400;
    }
}

std::string lines_of(const std::vector<std::string>& messages) {
    std::string text;
    for (const std::string& message : messages)
        text += (text.empty() ? "" : "\n") + message;
    return text;
}

/// Responds when the edit is in effect or refused. `field`: what of the request was at fault if
/// something cannot be loaded.
void edit(const Call& call, SceneEdit wanted, int status, std::string field) {
    auto done = [respond = call.respond, status,
                 field = std::move(field)](const EditOutcome& outcome) {
        if (outcome.result == EditOutcome::Result::done) {
            if (status == 204) return respond(no_content());
            Json document{{"warnings", outcome.messages}};
            if (!outcome.notes.empty()) document["notes"] = outcome.notes;
            return respond(ok(document, status));
        }
        const bool named = outcome.result == EditOutcome::Result::faulty ||
                           outcome.result == EditOutcome::Result::forbidden;
        respond(problem(status_of(outcome.result), lines_of(outcome.messages), named ? field : ""));
    };
    call.api.edit_scene(std::move(wanted), std::move(done), call.request.withdrawn);
}

HttpResponse no_model(const std::string& name) {
    return problem(404,
                   "there is no movable model \"" + name + "\"; GET /scene lists what there is");
}

std::string_view name_of(const AddModel& model) {
    if (!model.sdf.empty()) return "sdf";
    if (!model.mesh_data.empty()) return "mesh_data";
    return model.file.empty() ? "mesh" : "file";
}

}  // namespace

void get_scene(Call&& call) {
    call.respond(ok(scene_document(call.api, call.api.scene())));
}

void put_scene(Call&& call) {
    auto parsed = parse_load_world(call.request.body);
    if (!parsed) return call.respond(bad_request(parsed.error()));
    edit(call, *std::move(parsed), 200, "file");
}

void post_model(Call&& call) {
    auto parsed = parse_add_model(call.request.body);
    if (!parsed) return call.respond(bad_request(parsed.error()));
    std::string field{name_of(*parsed)};
    edit(call, *std::move(parsed), 201, std::move(field));
}

void delete_model(Call&& call) {
    edit(call, RemoveModel{call.names[0]}, 204, {});
}

void put_material(Call&& call) {
    auto parsed = parse_set_material(call.names[0], call.request.body);
    if (!parsed) return call.respond(bad_request(parsed.error()));
    edit(call, *std::move(parsed), 200, "material");
}

void get_model_pose(Call&& call) {
    const std::string& name = call.names[0];
    const auto pose = call.api.model_pose(name);
    call.respond(pose ? ok(pose_line_document("model", name, *pose)) : no_model(name));
}

void put_model_pose(Call&& call) {
    const std::string& name = call.names[0];
    if (!call.api.model_pose(name)) return call.respond(no_model(name));
    const auto said = pose_in(call, "model");
    if (!said) return call.respond(bad_request(said.error()));
    call.respond(placed(call, [&] { return call.api.set_model_pose(name, *said); }));
}

}  // namespace scipd::daemon
