// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What fills the air of the world.
#include <utility>

#include "daemon/api/pose_routes.h"
#include "daemon/api/scene_edit_request.h"
#include "daemon/http/problem.h"

namespace scipd::daemon {

void get_media(Call&& call) {
    call.respond(ok(media_document(call.api.media())));
}

void put_media(Call&& call) {
    auto parsed = parse_media(call.request.body);
    if (!parsed) return call.respond(bad_request(parsed.error()));
    const std::vector<std::string> notes = call.api.set_media(*std::move(parsed));
    Json document{{"warnings", Json::array()}};
    if (!notes.empty()) document["notes"] = notes;
    call.respond(ok(document));
}

void delete_media(Call&& call) {
    (void)call.api.set_media({});
    call.respond(no_content());
}

}  // namespace scipd::daemon
