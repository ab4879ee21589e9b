// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a page draws: the objects of the scene where they are now, and their triangles. On the I/O
// thread.
#include <algorithm>
#include <utility>

#include "daemon/api/documents.h"
#include "daemon/api/object_text.h"
#include "daemon/api/route_handlers.h"
#include "daemon/api/scene_gallery.h"
#include "daemon/http/problem.h"

namespace scipd::daemon {
namespace {

/// Light of most scanners.
constexpr int shown_wavelength_nm = 905;

Json materials_document(const WorldView& world) {
    Json materials = Json::array();
    for (const sim::Material& material : world.scene->materials) {
        const sim::Surface surface = world.materials->surface(material, shown_wavelength_nm);
        const auto share = [](float value) { return rounded(static_cast<double>(value)); };
        materials.push_back({{"name", material.name},
                             {"known", world.materials->find(material.name) != nullptr},
                             {"reflectivity", share(surface.diffuse + surface.specular)},
                             {"specular", share(surface.specular)},
                             {"retro", share(surface.retro)},
                             {"transmission", share(surface.transmission)}});
    }
    return materials;
}

/// The JSON name of the robot whose body each model is, or null.
std::vector<std::string> robots_by_model(const WorldView& world) {
    std::vector<std::string> robots(world.scene->models.size(), "null");
    for (const RobotView& robot : world.robots) {
        if (robot.body != sim::no_model) robots[robot.body] = text_of(robot.name);
    }
    return robots;
}

std::string document(const WorldView& world, const SceneObjects& objects) {
    const sim::Scene& scene = *world.scene;
    const auto robots = robots_by_model(world);
    ObjectText text({{"version", world.version},
                     {"loaded", world.loaded},
                     {"time_s", seconds(world.time)},
                     {"limits", {{"http_body_bytes", world.most_body_bytes}}}});
    text.add_list("objects", objects.size(), [&](std::string& list, std::size_t id) {
        const sim::Object& object = scene.objects[id];
        list += objects.text(static_cast<sim::ObjectId>(id));
        list += ",\"robot\":" + robots[object.model] + ",\"pose\":";
        append_pose(list, world.models[object.model] * object.model_from_object);
        list += '}';
    });
    text.add("materials", materials_document(world));
    return std::move(text).finish();
}

// Where things are is asked when the objects are made: meanwhile they have moved, and maybe others
// are there.
void respond_with_objects(Api& api, const Respond& respond) {
    const sim::SharedScene scene = api.world().scene;
    api.gallery().objects(scene, [&api, scene, respond](const SharedObjects& objects) {
        const WorldView world = api.world();
        if (world.scene != scene) return respond_with_objects(api, respond);
        respond(ok_text(document(world, *objects)));
    });
}

}  // namespace

void get_objects(Call&& call) {
    respond_with_objects(call.api, call.respond);
}

void get_mesh(Call&& call) {
    auto take = [respond = call.respond, hash = call.names[0]](std::optional<std::string> bytes) {
        if (!bytes) {
            return respond(problem(404, "no object has the mesh \"" + hash +
                                            "\"; GET /scene/objects lists what there is"));
        }
        respond({.content_type = "application/octet-stream",
                 .body = std::move(*bytes),
                 .headers = {{"Cache-Control", "private, max-age=31536000, immutable"}}});
    };
    call.api.gallery().triangles(call.api.world().scene, call.names[0], std::move(take));
}

}  // namespace scipd::daemon
