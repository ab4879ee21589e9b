// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The world and the configuration as they are now, as texts that can be loaded again. On the I/O
// thread.
#include <utility>

#include "daemon/api/route_handlers.h"
#include "daemon/api/scene_gallery.h"
#include "daemon/config/saved_config.h"
#include "sim/export/sdf_text.h"

namespace scipd::daemon {
namespace {

HttpResponse text(const char* type, std::string body) {
    return {.content_type = type, .body = std::move(body)};
}

// As with the objects that pages draw: meanwhile another scene may be there.
void respond_with_sdf(Api& api, const Respond& respond) {
    const sim::SharedScene scene = api.world().scene;
    api.gallery().objects(scene, [&api, scene, respond](const SharedObjects& objects) {
        const WorldView world = api.world();
        if (world.scene != scene) return respond_with_sdf(api, respond);
        const auto uri = [&](sim::ObjectId id) { return "meshes/" + objects->hash(id) + ".stl"; };
        respond(text("application/xml", sim::sdf_of(*scene, world.models, uri)));
    });
}

}  // namespace

void get_sdf(Call&& call) {
    respond_with_sdf(call.api, call.respond);
}

void get_configuration(Call&& call) {
    call.respond(text("application/yaml", saved_config(call.api.configuration(), "world.sdf")));
}

}  // namespace scipd::daemon
