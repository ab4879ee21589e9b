// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/pose_routes.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "daemon/api/documents.h"
#include "daemon/http/problem.h"

namespace scipd::daemon {
namespace {

/// What parse_pose_line()'s sentence names: it begins with the field, or quotes an unknown key.
std::string field_of(std::string_view refusal) {
    constexpr std::string_view unknown = "the key '";
    if (refusal.starts_with(unknown)) {
        refusal.remove_prefix(unknown.size());
        return std::string{refusal.substr(0, refusal.find('\''))};
    }
    const auto word = refusal.substr(0, refusal.find_first_of(" :"));
    constexpr std::array<std::string_view, 8> fields{"robot", "model", "t", "xyz",
                                                     "q",     "rpy",   "v", "w"};
    return std::find(fields.begin(), fields.end(), word) == fields.end() ? "" : std::string{word};
}

std::optional<HttpResponse> misnamed(const Call& call, const sim::PoseLine& line,
                                     const std::string& kind) {
    const bool of_robot = kind == "robot";
    const std::string other = of_robot ? "model" : "robot";
    if (!(of_robot ? line.model : line.robot).empty()) {
        return problem(400, other + " does not belong here", other);
    }
    const std::string& name = of_robot ? line.robot : line.model;
    if (name.empty() || name == call.names[0]) return std::nullopt;
    return problem(400, kind + " must be the one of the path, or left out", kind);
}

HttpResponse no_robot(const std::string& robot) {
    return problem(404, "there is no robot \"" + robot + "\"");
}

}  // namespace

Json pose_line_document(const char* kind, const std::string& name, const sim::TimedPose& timed) {
    Json document{{kind, name}, {"t", seconds(timed.time)}};
    document.update(pose_document(timed.pose));
    return document;
}

std::variant<sim::PoseLine, HttpResponse> pose_in(const Call& call, const char* kind) {
    const std::string& body = call.request.body;
    const auto begin = body.find_first_not_of(" \t\r\n");
    if (begin == body.npos || body[begin] != '{') {
        return problem(400, R"(the body must be a JSON object such as {"xyz":[1,2,0]})");
    }
    const auto parsed = sim::parse_pose_line(body);
    if (const auto* refusal = std::get_if<std::string>(&parsed)) {
        return pose_refused(*refusal);
    }
    const auto& line = std::get<sim::PoseLine>(parsed);
    if (auto refusal = misnamed(call, line, kind)) return *std::move(refusal);
    return line;
}

HttpResponse pose_refused(const std::string& refusal) {
    return problem(400, refusal, field_of(refusal));
}

HttpResponse accepted(const std::optional<std::string>& refusal) {
    return refusal ? problem(409, *refusal) : no_content();
}

void get_robot_pose(Call&& call) {
    const std::string& robot = call.names[0];
    const auto pose = call.api.robot_pose(robot);
    call.respond(pose ? ok(pose_line_document("robot", robot, *pose)) : no_robot(robot));
}

void put_robot_pose(Call&& call) {
    const std::string& robot = call.names[0];
    if (!call.api.robot_pose(robot)) return call.respond(no_robot(robot));
    const auto said = pose_in(call, "robot");
    if (const auto* refusal = std::get_if<HttpResponse>(&said)) return call.respond(*refusal);
    call.respond(accepted(call.api.set_robot_pose(robot, std::get<sim::PoseLine>(said))));
}

}  // namespace scipd::daemon
