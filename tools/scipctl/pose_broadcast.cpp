// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipctl/pose_broadcast.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <optional>
#include <thread>
#include <utility>

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/post.hpp>

#include "daemon/fleet/pose_sender.h"
#include "sim/loaders/poses/pose_line.h"
#include "tools/control_client.h"

namespace scipd::tools {

namespace asio = boost::asio;
using namespace std::chrono_literals;

namespace {

/// Another thread has the connection, since reading lines may take for ever.
class Broadcast {
  public:
    explicit Broadcast(const BrokerOptions& options)
        : session_(options),
          sender_(session_.io().get_executor(), session_.link(), session_.topics(),
                  session_.name()),
          thread_([this] {
              session_.link().begin();
              session_.io().run();
          }) {}
    ~Broadcast() { stop(); }
    Broadcast(const Broadcast&) = delete;
    Broadcast& operator=(const Broadcast&) = delete;

    void send(sim::PoseLine line) {
        while (waiting_ > most_waiting)
            std::this_thread::sleep_for(1ms);
        ++waiting_;
        asio::post(session_.io(), [this, line = std::move(line)] {
            --waiting_;
            sender_.send(line);
        });
    }

    /// All that was sent is with the broker.
    void finish() {
        std::atomic<bool> done = false;
        for (auto end = std::chrono::steady_clock::now() + 10s;
             !done && std::chrono::steady_clock::now() < end;) {
            asio::post(session_.io(), [&] { done = done || sender_.idle(); });
            std::this_thread::sleep_for(10ms);
        }
        stop();
        session_.finish();
    }

  private:
    static constexpr int most_waiting = 10'000;

    void stop() {
        session_.io().stop();
        if (thread_.joinable()) thread_.join();
    }

    BrokerSession session_;
    daemon::PoseSender sender_;
    std::atomic<int> waiting_ = 0;
    std::thread thread_;
};

sim::Expected<sim::PoseLine> line_for_many(const std::string& text, const std::string& robot) {
    return sim::parse_pose_line(text).and_then(
        [&](sim::PoseLine line) -> sim::Expected<sim::PoseLine> {
            if (line.robot.empty() && line.model.empty()) line.robot = robot;
            if (line.robot.empty() && line.model.empty())
                return sim::refuse("robot is missing: name it in the line or with --robot");
            return line;
        });
}

}  // namespace

void for_each_line_for_many(std::istream& lines, const std::string& robot,
                            const std::function<sim::Expected<>(const sim::PoseLine&)>& take) {
    std::uint64_t number = 0;
    std::uint64_t refused = 0;
    for (std::string text; std::getline(lines, text);) {
        ++number;
        if (sim::says_nothing(text)) continue;
        const auto taken = line_for_many(text, robot).and_then(take);
        if (taken) continue;
        ++refused;
        std::cerr << "line " << number << ": " << taken.error().why << '\n';
    }
    if (refused == 0) return;
    throw ControlError(
        0, std::to_string(refused) + " of " + std::to_string(number) + " lines were refused");
}

// What was good is sent, whatever was refused.
void broadcast_poses(const BrokerOptions& options, const std::string& robot, std::istream& lines) {
    Broadcast broadcast(options);
    std::optional<ControlError> refused;
    try {
        for_each_line_for_many(lines, robot, [&](const sim::PoseLine& line) -> sim::Expected<> {
            broadcast.send(line);
            return {};
        });
    } catch (const ControlError& error) {
        refused = error;
    }
    broadcast.finish();
    if (refused) throw ControlError(*refused);
}

}  // namespace scipd::tools
