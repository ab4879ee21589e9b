// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/routes.h"

#include <algorithm>
#include <array>
#include <utility>

#include "daemon/api/pose_routes.h"
#include "daemon/http/problem.h"
#include "daemon/http/url.h"

namespace scipd::daemon {
namespace {

/// The path between its slashes.
using Segments = std::vector<std::string>;

/// Answers those who ask for a WebSocket without an upgrade.
void ask_for_upgrade(Call&& call) {
    call.respond(
        problem(426, call.request.path + " is a WebSocket: request it with Upgrade: websocket"));
}

constexpr std::array<Route, 47> table{{
    {"GET", "/", get_page},
    {"GET", "/favicon.ico", get_icon},
    {"GET", "/page/{file}", get_page_file},
    {"GET", "/status", get_status},
    {"GET", "/health", get_health},
    {"GET", "/metrics", get_metrics},
    {"GET", "/configuration", get_configuration},
    {"GET", "/sensors", get_sensors},
    {"POST", "/sensors", post_sensor},
    {"GET", "/sensors/models", get_models},
    {"GET", "/sensors/{robot}/{sensor}", get_sensor},
    {"PATCH", "/sensors/{robot}/{sensor}", patch_sensor},
    {"DELETE", "/sensors/{robot}/{sensor}", delete_sensor},
    {"GET", "/sensors/{robot}/{sensor}/reading", get_reading},
    {"GET", "/sensors/{robot}/{sensor}/recording", get_recording},
    {"GET", "/sensors/{robot}/{sensor}/replay", get_replay},
    {"PATCH", "/sensors/{robot}/{sensor}/replay", patch_replay},
    {"GET", "/sensors/{robot}/{sensor}/truth", get_truth},
    {"POST", "/sensors/{robot}/{sensor}/faults", post_fault},
    {"GET", "/sensors/{robot}/{sensor}/faults", get_faults},
    {"DELETE", "/sensors/{robot}/{sensor}/faults", delete_faults},
    {"GET", "/sensors/{robot}/{sensor}/faults/log", get_fault_log},
    {"GET", "/sensors/{robot}/{sensor}/faults/{fault}", get_fault},
    {"DELETE", "/sensors/{robot}/{sensor}/faults/{fault}", delete_fault},
    {"GET", "/faults/kinds", get_fault_kinds},
    {"GET", "/scenario", get_scenario},
    {"PUT", "/scenario", put_scenario},
    {"DELETE", "/scenario", delete_scenario},
    {"GET", "/robots/{robot}/pose", get_robot_pose},
    {"PUT", "/robots/{robot}/pose", put_robot_pose},
    {"GET", "/scene", get_scene},
    {"PUT", "/scene", put_scene},
    {"GET", "/scene/objects", get_objects},
    {"GET", "/scene/meshes/{mesh}", get_mesh},
    {"GET", "/scene/sdf", get_sdf},
    {"GET", "/scene/media", get_media},
    {"PUT", "/scene/media", put_media},
    {"DELETE", "/scene/media", delete_media},
    {"POST", "/scene/models", post_model},
    {"DELETE", "/scene/models/{model}", delete_model},
    {"PUT", "/scene/models/{model}/material", put_material},
    {"GET", "/scene/models/{model}/pose", get_model_pose},
    {"PUT", "/scene/models/{model}/pose", put_model_pose},
    {"GET", "/poses", ask_for_upgrade},
    {"GET", "/stream", ask_for_upgrade},
    {"GET", "/view", ask_for_upgrade},
    {"GET", "/wire", ask_for_upgrade},
}};

Segments split(std::string_view path) {
    Segments segments;
    while (path.starts_with('/')) {
        path.remove_prefix(1);
        const auto end = std::min(path.find('/'), path.size());
        segments.emplace_back(path.substr(0, end));
        path.remove_prefix(end);
    }
    return segments;
}

bool matches(const Segments& pattern, const Segments& path) {
    return std::ranges::equal(pattern, path, [](const auto& wanted, const auto& segment) {
        return wanted.starts_with('{') ? !segment.empty() : wanted == segment;
    });
}

/// What the braces stand for; nothing where a % is not followed by two hexadecimal digits.
std::optional<std::vector<std::string>> names_in(const Segments& pattern, const Segments& path) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        if (!pattern[i].starts_with('{')) continue;
        auto name = percent_decoded(path[i]);
        if (!name) return std::nullopt;
        names.push_back(std::move(*name));
    }
    return names;
}

/// Names each path of the table once: "/status, /sensors, .."
std::string all_paths() {
    std::string text;
    std::string_view last;
    for (const Route& entry : table) {
        if (entry.path == last) continue;
        text += (text.empty() ? "" : ", ") + std::string(entry.path);
        last = entry.path;
    }
    return text;
}

HttpResponse method_not_allowed(const HttpRequest& request, std::string allow) {
    auto response = problem(405, "use " + allow + " here, not " + request.method);
    response.allow = std::move(allow);
    return response;
}

HttpResponse not_found(const HttpRequest& request) {
    return problem(404, "there is no " + request.path + "; there are " + all_paths());
}

}  // namespace

std::span<const Route> routes() {
    return table;
}

void route(Api& api, const HttpRequest& request, Respond respond) {
    const Segments path = split(request.path);
    std::string allow;
    std::string_view meant;  // the first that matches: /faults/log is no /faults/{fault}
    for (const Route& entry : table) {
        const Segments pattern = split(entry.path);
        if (!matches(pattern, path) || (!meant.empty() && entry.path != meant)) continue;
        meant = entry.path;
        if (entry.method == request.method) {
            auto names = names_in(pattern, path);
            if (!names) {
                return respond(problem(400, "a % in the path must precede two hexadecimal digits"));
            }
            return entry.answer({api, request, std::move(*names), std::move(respond)});
        }
        allow += (allow.empty() ? "" : ", ") + std::string(entry.method);
    }
    respond(allow.empty() ? not_found(request) : method_not_allowed(request, allow));
}

std::variant<HttpResponse, Converse> open_socket(Api& api, const HttpRequest& request) {
    const std::string& path = request.path;
    const bool has_query = !request.query.empty();
    if (has_query && (path == "/poses" || path == "/view"))
        return problem(400, path + " takes no parameters");
    if (path == "/poses") return [&api](WebSocket& socket) { return take_poses(api, socket); };
    if (path == "/view") return [&api](WebSocket& socket) { return api.open_view(socket); };
    const bool is_wire = path == "/wire";
    if (!is_wire && path != "/stream") {
        return problem(404, path + " is no WebSocket; there are /poses, /stream, /view and /wire");
    }
    const std::string sensor = query_value(request.query, "sensor").value_or("");
    const bool is_alone = request.query.find('&') == request.query.npos;
    if (sensor.empty() ? is_wire || has_query : !is_alone) {
        return problem(400, "there is one parameter, ?sensor=ROBOT/SENSOR", "sensor");
    }
    if (!sensor.empty() && !api.log(sensor)) {
        return problem(404, "there is no sensor \"" + sensor + "\"", "sensor");
    }
    if (is_wire) {
        return [&api, sensor](WebSocket& socket) { return api.open_wire(sensor, socket); };
    }
    return [&api, sensor](WebSocket& socket) { return api.subscribe(sensor, socket); };
}

}  // namespace scipd::daemon
