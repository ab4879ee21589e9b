// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/socket_routes.h"

#include "daemon/api/pose_socket.h"
#include "daemon/api/scan_stream.h"
#include "daemon/http/problem.h"
#include "daemon/http/url.h"

namespace scipd::daemon {

std::variant<HttpResponse, Converse> open_socket(Api& api, const HttpRequest& request) {
    if (request.path == "/poses") {
        return [&api](WebSocket& socket) { return take_poses(api, socket); };
    }
    if (request.path != "/stream") {
        return problem(404, request.path + " is no WebSocket; there are /poses and /stream");
    }
    const std::string sensor = query_value(request.query, "sensor").value_or("");
    if (sensor.empty() && !request.query.empty()) {
        return problem(400, "there is one parameter, ?sensor=ROBOT/SENSOR", "sensor");
    }
    if (!sensor.empty() && api.scans(sensor) == nullptr && api.staring(sensor) == nullptr) {
        return problem(404, "there is no sensor \"" + sensor + "\"", "sensor");
    }
    return [&api, sensor](WebSocket& socket) { return api.stream().subscribe(sensor, socket); };
}

void ask_for_upgrade(Call&& call) {
    call.respond(problem(426, call.request.path + " is a WebSocket: ask with Upgrade: websocket"));
}

}  // namespace scipd::daemon
