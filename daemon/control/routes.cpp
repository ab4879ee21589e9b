// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/control/routes.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <variant>

#include <nlohmann/json.hpp>

#include "daemon/control/problem.h"

namespace scipd::daemon {
namespace {

using Json = nlohmann::ordered_json;
/// The path between its slashes.
using Segments = std::vector<std::string>;

template <class Value>
Json or_null(const std::optional<Value>& value) {
    return value ? Json(*value) : Json(nullptr);
}

double seconds(sim::Time time) {
    return std::chrono::duration<double>(time).count();
}

Json to_json(const std::optional<LatenessStatus>& lateness) {
    if (!lateness) return {{"p50", nullptr}, {"p99", nullptr}, {"max", nullptr}};
    return {{"p50", lateness->p50.count()},
            {"p99", lateness->p99.count()},
            {"max", lateness->max.count()}};
}

Json to_json(const SensorStatus& sensor) {
    return {{"name", sensor.name},        {"model", sensor.model},
            {"backend", sensor.backend},  {"state", sensor.state},
            {"tcp", or_null(sensor.tcp)}, {"pty", or_null(sensor.pty)},
            {"clients", sensor.clients},  {"scans", sensor.scans},
            {"lost", sensor.lost},        {"lateness_ms", to_json(sensor.lateness)}};
}

Json to_json(const std::vector<SensorStatus>& sensors) {
    Json list = Json::array();
    for (const SensorStatus& sensor : sensors)
        list.push_back(to_json(sensor));
    return list;
}

Json to_json(const Status& status) {
    return {{"uptime_s", status.uptime.count()},
            {"clock", status.clock},
            {"time_s", seconds(status.time)},
            {"scene", status.scene},
            {"poses",
             {{"accepted", status.poses.accepted},
              {"refused", status.poses.refused},
              {"last_refusal", or_null(status.poses.last_refusal)}}},
            {"sensors", to_json(status.sensors)}};
}

/// In the words of a pose line, so that an answer can be sent as one.
Json to_json(const std::string& robot, const sim::TimedPose& timed) {
    const auto& [xyz_m, q] = timed.pose;
    return {{"robot", robot},
            {"t", seconds(timed.time)},
            {"xyz", {xyz_m.x, xyz_m.y, xyz_m.z}},
            {"q", {q.x, q.y, q.z, q.w}}};
}

HttpResponse ok(const Json& document) {
    HttpResponse response;
    response.body = document.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
    return response;
}

HttpResponse method_not_allowed(const HttpRequest& request, std::string allow) {
    auto response = problem(405, "use " + allow + " here, not " + request.method);
    response.allow = std::move(allow);
    return response;
}

/// What parse_pose_line()'s sentence names: it begins with the field, or quotes an unknown key.
std::string field_of(std::string_view refusal) {
    constexpr std::string_view unknown = "the key '";
    if (refusal.starts_with(unknown)) {
        refusal.remove_prefix(unknown.size());
        return std::string{refusal.substr(0, refusal.find('\''))};
    }
    const auto word = refusal.substr(0, refusal.find(' '));
    constexpr std::array<std::string_view, 6> fields{"robot", "model", "t", "xyz", "q", "rpy"};
    return std::find(fields.begin(), fields.end(), word) == fields.end() ? "" : std::string{word};
}

HttpResponse put_pose(Api& api, const std::string& robot, const std::string& body) {
    const auto begin = body.find_first_not_of(" \t\r\n");
    if (begin == body.npos || body[begin] != '{') {
        return problem(400, R"(the body must be a JSON object such as {"xyz":[1,2,0]})");
    }
    const auto parsed = sim::parse_pose_line(body);
    if (const auto* refusal = std::get_if<std::string>(&parsed)) {
        return problem(400, *refusal, field_of(*refusal));
    }
    const auto& line = std::get<sim::PoseLine>(parsed);
    if (!line.model.empty()) return problem(400, "model does not belong here", "model");
    if (!line.robot.empty() && line.robot != robot) {
        return problem(400, "robot must be the one of the path, or left out", "robot");
    }
    if (const auto refusal = api.set_robot_pose(robot, line.time, line.pose)) {
        return problem(409, *refusal);
    }
    return {.status = 204, .content_type = {}, .body = {}, .allow = {}};
}

HttpResponse robot_pose(Api& api, const HttpRequest& request, const std::string& robot) {
    const auto pose = api.robot_pose(robot);
    if (!pose) return problem(404, "there is no robot \"" + robot + "\"");
    if (request.method == "GET") return ok(to_json(robot, *pose));
    if (request.method == "PUT") return put_pose(api, robot, request.body);
    return method_not_allowed(request, "GET, PUT");
}

HttpResponse sensor(const Api& api, const std::string& name) {
    for (const SensorStatus& candidate : api.status().sensors) {
        if (candidate.name == name) return ok(to_json(candidate));
    }
    return problem(404, "there is no sensor \"" + name + "\"");
}

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

/// What the control API is to have, and has not yet.
bool comes_later(const Segments& path) {
    const std::string& first = path.front();
    const bool of_sensor = first == "sensors" && path.size() == 4;
    return first == "scene" || (path.size() == 1 && (first == "poses" || first == "stream")) ||
           (of_sensor && (path[3] == "truth" || path[3] == "faults"));
}

HttpResponse dispatch(Api& api, const HttpRequest& request) {
    const Segments path = split(request.path);
    const bool is_get = request.method == "GET";
    if (path == Segments{"status"}) {
        return is_get ? ok(to_json(api.status())) : method_not_allowed(request, "GET");
    }
    if (path == Segments{"sensors"}) {
        return is_get ? ok(to_json(api.status().sensors)) : method_not_allowed(request, "GET");
    }
    if (path.size() == 3 && path[0] == "sensors") {
        return is_get ? sensor(api, path[1] + "/" + path[2]) : method_not_allowed(request, "GET");
    }
    if (path.size() == 3 && path[0] == "robots" && path[2] == "pose") {
        return robot_pose(api, request, path[1]);
    }
    if (!path.empty() && comes_later(path)) {
        return problem(404, request.path + " is not in this version");
    }
    return problem(404, "there is no " + request.path +
                            "; there are /status, /sensors, /sensors/ROBOT/SENSOR and "
                            "/robots/ROBOT/pose");
}

}  // namespace

HttpResponse route(Api& api, const HttpRequest& request) {
    return dispatch(api, request);
}

}  // namespace scipd::daemon
