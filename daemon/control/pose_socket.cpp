// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/control/pose_socket.h"

#include <algorithm>
#include <cstdint>

#include "daemon/control/documents.h"
#include "daemon/control/pose_intake.h"
#include "daemon/control/pose_routes.h"

namespace scipd::daemon {
namespace {

class PoseSocket : public Conversation {
  public:
    PoseSocket(Api& api, WebSocket& socket) : api_(api), socket_(socket) {}

    void take(std::string_view message) override {
        while (!message.empty()) {
            const std::size_t end = std::min(message.find('\n'), message.size());
            take_line(message.substr(0, end));
            message.remove_prefix(std::min(end + 1, message.size()));
        }
    }

  private:
    void take_line(std::string_view line) {
        ++lines_;
        if (sim::says_nothing(line)) return;
        const auto refusal = api_.take_pose_line(line, sender_);
        if (!refusal) return;
        Json document = Json::parse(pose_refused(*refusal).body);
        document["line"] = lines_;
        socket_.send(std::make_shared<const std::string>(text_of(document)));
    }

    Api& api_;
    WebSocket& socket_;
    SenderClock sender_;
    std::uint64_t lines_ = 0;  ///< since the beginning, empty ones as well
};

}  // namespace

std::unique_ptr<Conversation> take_poses(Api& api, WebSocket& socket) {
    return std::make_unique<PoseSocket>(api, socket);
}

}  // namespace scipd::daemon
