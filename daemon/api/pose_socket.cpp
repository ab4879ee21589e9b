// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/pose_socket.h"

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

std::unique_ptr<Conversation> take_poses(Api& api, WebSocket& socket) {
    return std::make_unique<PoseSocket>(api, socket);
}

}  // namespace scipd::daemon
