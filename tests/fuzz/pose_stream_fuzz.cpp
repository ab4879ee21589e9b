// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Any bytes over the WebSocket of poses, to a world with two robots and a crate. The first byte
// chooses lockstep or the wall clock, and the policy. Zero bytes end messages. For each message
// scipd reports the first refused line with its number, and how many were refused, and nothing
// else. Afterwards everything must have a finite position.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <nlohmann/json.hpp>

#include "daemon/api/pose_routes.h"
#include "daemon/poses/lockstep.h"
#include "daemon/poses/pose_intake.h"
#include "daemon/world/world.h"
#include "sim/sensor/equal_parts.h"
#include "tests/support/empty_api.h"

namespace {

using namespace scipd;
using namespace std::chrono_literals;

void require(bool holds, const char* what) {
    if (holds) return;
    std::cerr << "does not hold: " << what << '\n';
    std::abort();
}

sim::PosePolicy policy_of(unsigned choice) {
    constexpr std::array after{sim::PosePolicy::After::hold, sim::PosePolicy::After::extrapolate,
                               sim::PosePolicy::After::absent, sim::PosePolicy::After::extrapolate};
    sim::PosePolicy policy;
    policy.after = after[choice % 4];
    policy.absent_before = (choice & 4U) != 0;
    if ((choice & 8U) != 0) policy.stale_after = 1h;
    if ((choice & 16U) != 0) policy.fastest_mps = 1e9;
    return policy;
}

/// Records what scipd sends to the client.
class Client : public daemon::WebSocket {
  public:
    void send(std::shared_ptr<const std::string> message) override {
        const auto document = nlohmann::json::parse(*message, nullptr, false);
        require(document.is_object(), "a message is a JSON object");
        require(document["status"] == 400, "of a refusal");
        require(!document["detail"].get<std::string>().empty(), "that says why");
        const auto line = document["line"].get<std::uint64_t>();
        require(line > last_line_, "and which line, in their order");
        last_line_ = line;
        const auto refused = document["refused"].get<std::uint64_t>();
        require(refused > 0, "and how many");
        told_ += refused;
    }
    void send_bytes(std::shared_ptr<const std::string>) override {
        require(false, "all that is said here is text");
    }
    void cut() override {}
    [[nodiscard]] std::uint64_t told() const { return told_; }

  private:
    std::uint64_t last_line_ = 0;
    std::uint64_t told_ = 0;
};

class Daemon : public tests::EmptyApi {
  public:
    explicit Daemon(unsigned choice)
        : in_lockstep_((choice & 0x80U) != 0),
          intake_(world_, in_lockstep_ ? &lockstep_ : nullptr) {
        const auto scene = std::make_shared<sim::Scene>();
        scene->models = {{.name = "crate", .movable = true, .world_from_model = {}}};
        world_.replace_scene(scene, {});
        const sim::PosePolicy policy = policy_of(choice);
        world_.set_robots({{"a", {{}, policy, {}}}, {"b", {{}, policy, {}}}});
    }

    sim::Expected<> take_pose_line(std::string_view line, daemon::SenderClock& sender) override {
        auto taken = intake_.take_line(line, {}, sender, now_);
        asked_.push_back(now_);
        for (const auto* track : tracks())
            asked_.push_back(track->last_time());
        now_ += 50ms;
        return taken;
    }

    /// Carries out what lockstep has been told to do.
    void settle() {
        io_.restart();
        io_.poll();
    }

    void check(std::uint64_t told) {
        require(told == intake_.refused(), "every refusal is told, and nothing else");
        for (const sim::Time time : asked_) {
            // The start pose has the smallest time there is.
            if (time == sim::Time::min()) continue;
            for (const sim::Time at : {time - 1ns, time, time + 1ns, time + 700ms}) {
                check_at(at);
                check_sweep(at);
            }
        }
    }

  private:
    [[nodiscard]] std::array<const sim::PoseTrack*, 3> tracks() const {
        return {world_.robot("a"), world_.robot("b"), world_.model("crate")};
    }

    void check_sweep(sim::Time begin) {
        const auto fired = [&](std::size_t beam) { return begin + beam * 1ms; };
        const auto parts =
            sim::equal_parts(25, 7, fired, world_.movers().all(begin, fired(24), sim::no_model));
        require(!parts.empty() && parts.size() <= 7, "no more parts than poses");
    }

    void check_at(sim::Time time) const {
        static_cast<void>(world_.poses_known(time));
        for (const auto* track : tracks()) {
            const sim::Pose pose = track->at(time);
            const auto& p = pose.translation_m;
            // A pose may be 1e7 m away, and extrapolation may last for an hour at 1e9 m/s.
            require(std::abs(p.x) + std::abs(p.y) + std::abs(p.z) < 2e13, "somewhere");
            require(std::abs(glm::length(pose.rotation) - 1.0) < 1e-9, "a unit quaternion");
            static_cast<void>(track->absent(time));
            if (track->still(time, time + 25ms))
                require(track->at(time + 10ms) == pose, "what is still does not move");
        }
    }

    bool in_lockstep_;
    boost::asio::io_context io_;
    daemon::Lockstep lockstep_{io_.get_executor()};
    daemon::World world_;
    daemon::PoseIntake intake_;
    sim::Time now_ = 10s;
    std::vector<sim::Time> asked_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    std::string_view rest{reinterpret_cast<const char*>(data) + 1, size - 1};
    Daemon daemon(data[0]);
    Client client;
    const auto conversation = daemon::take_poses(daemon, client);
    while (!rest.empty()) {
        const auto end = std::min(rest.find('\0'), rest.size());
        for (std::string_view message = rest.substr(0, end); !message.empty();)
            message.remove_prefix(conversation->take(message));
        rest.remove_prefix(std::min(end + 1, rest.size()));
        daemon.settle();
    }
    daemon.check(client.told());
    return 0;
}
