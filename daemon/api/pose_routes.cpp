// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/pose_routes.h"

#include <cstdint>
#include <string>
#include <utility>

#include "daemon/api/documents.h"
#include "daemon/http/problem.h"
#include "daemon/limits/rate.h"
#include "daemon/poses/pose_intake.h"
#include "daemon/poses/some_lines.h"

namespace scipd::daemon {
namespace {

/// The line, unless it names something else than the path does.
sim::Expected<sim::PoseLine> well_named(const sim::PoseLine& line, const std::string& kind,
                                        const std::string& name_in_path) {
    const bool of_robot = kind == "robot";
    const std::string other = of_robot ? "model" : "robot";
    if (!(of_robot ? line.model : line.robot).empty())
        return sim::refuse(other, other + " does not belong here");
    const std::string& name = of_robot ? line.robot : line.model;
    if (!name.empty() && name != name_in_path)
        return sim::refuse(kind, kind + " must be the one of the path, or left out");
    return line;
}

HttpResponse no_robot(const std::string& robot) {
    return problem(404, "there is no robot \"" + robot + "\"");
}

class PoseSocket : public Conversation {
  public:
    PoseSocket(Api& api, WebSocket& socket) : api_(api), socket_(socket) {}

    std::size_t take(std::string_view rest) override {
        const std::size_t taken =
            take_some_lines(rest, [this](std::string_view line) { take_line(line); });
        if (taken == rest.size()) answer();
        return taken;
    }

  private:
    /// The lines of one message that were refused.
    struct Refused {
        std::uint64_t lines = 0;
        std::uint64_t first_line = 0;
        HttpResponse first_answer;
    };

    void take_line(std::string_view line) {
        ++lines_;
        if (sim::says_nothing(line)) return;
        if (const auto admitted = api_.admit_pose(rate_); !admitted)
            return refuse(429, admitted.error());
        if (const auto taken = api_.take_pose_line(line, sender_); !taken)
            refuse(400, taken.error());
    }

    void refuse(int status, const sim::Fault& fault) {
        if (++refused_.lines == 1) refused_ = {1, lines_, problem(status, fault.why, fault.field)};
    }

    void answer() {
        const Refused refused = std::exchange(refused_, {});
        if (refused.lines == 0) return;
        Json document = Json::parse(refused.first_answer.body);
        document["line"] = refused.first_line;
        document["refused"] = refused.lines;
        socket_.send(std::make_shared<const std::string>(text_of(document)));
    }

    Api& api_;
    WebSocket& socket_;
    SenderClock sender_;
    Rate rate_;
    std::uint64_t lines_ = 0;  ///< since the beginning, empty ones as well
    Refused refused_;
};

}  // namespace

Json pose_line_document(const char* kind, const std::string& name, const sim::TimedPose& timed) {
    Json document{{kind, name}, {"t", seconds(timed.time)}};
    document.update(pose_document(timed.pose));
    return document;
}

sim::Expected<sim::PoseLine> pose_in(const Call& call, const char* kind) {
    const std::string& body = call.request.body;
    const auto begin = body.find_first_not_of(" \t\r\n");
    if (begin == body.npos || body[begin] != '{')
        return sim::refuse(R"(the body must be a JSON object such as {"xyz":[1,2,0]})");
    return sim::parse_pose_line(body).and_then(
        [&](const sim::PoseLine& line) { return well_named(line, kind, call.names[0]); });
}

HttpResponse bad_request(const sim::Fault& fault) {
    return problem(400, fault.why, fault.field);
}

HttpResponse placed(const Call& call, const std::function<sim::Expected<>()>& place) {
    if (const auto admitted = call.api.admit_pose(*call.request.rate); !admitted)
        return problem(429, admitted.error().why);
    const auto taken = place();
    return taken ? no_content() : problem(409, taken.error().why);
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
    if (!said) return call.respond(bad_request(said.error()));
    call.respond(placed(call, [&] { return call.api.set_robot_pose(robot, *said); }));
}

std::unique_ptr<Conversation> take_poses(Api& api, WebSocket& socket) {
    return std::make_unique<PoseSocket>(api, socket);
}

}  // namespace scipd::daemon
