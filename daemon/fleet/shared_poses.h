// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Poses that many daemons share: those that are taken here go to the others, and theirs are taken
// here. Lives on the I/O thread.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/steady_timer.hpp>

#include "daemon/clock/clock.h"
#include "daemon/config/config.h"
#include "daemon/fleet/nearness.h"
#include "daemon/fleet/pose_receiver.h"
#include "daemon/fleet/pose_sender.h"
#include "daemon/fleet/shared_time.h"
#include "daemon/limits/rate.h"
#include "daemon/limits/throttle.h"
#include "daemon/poses/pose_intake.h"
#include "daemon/world/world.h"
#include "sim/time.h"

namespace scipd::daemon {

class SharedPoses {
  public:
    /// Pose lines by their sender, as the broker keeps them.
    using Places = std::map<std::string, std::string>;

    /// All must outlive it.
    struct Parts {
        World& world;
        PoseIntake& intake;
        const Clock& clock;
        /// The body of a robot that another daemon has; empty: nobody knows of one.
        std::function<std::string(const std::string& robot)> body_of;
        Lockstep* lockstep = nullptr;  ///< null: on the wall clock
        std::optional<double> near_m;  ///< what is farther from all robots here is left out
    };

    SharedPoses(const boost::asio::any_io_executor& executor, MqttLink& link, const Topics& topics,
                const std::string& name, Parts parts);
    /// As stop().
    ~SharedPoses();

    /// From now on what is taken here is told.
    void begin();
    /// These are the robots here. Where their bodies are is told.
    void serve(const std::vector<RobotConfig>& robots);
    void stop();

    /// Puts all where it was when others, and `with_own` this daemon, were there before.
    void put(const Places& places, bool with_own);
    /// One message of anybody's.
    void take(std::string_view frame);
    /// Has the broker say what the vehicles do that are robots here.
    void ask_vehicles();
    /// One step of the time that is shared.
    void take_step(std::string_view text);
    /// What a vehicle says of itself, by VDA 5050; of others nothing is taken.
    void take_vehicle(const std::string& topic, std::string_view state);
    /// The model is another one now.
    void forget(const std::string& model) { sender_.forget(model); }
    /// Messages, since the broker or this daemon was too slow.
    [[nodiscard]] std::uint64_t dropped() const { return sender_.dropped() + receiver_.dropped(); }
    void say_all() { sender_.say_all(clock_.now()); }

  private:
    /// A vehicle, as a sender of poses.
    struct Vehicle {
        std::string robot;
        SenderClock clock;
        Rate rate;
        Throttle refusals_told;
    };

    void listen_to(const std::vector<RobotConfig>& robots);
    void look_around();
    [[nodiscard]] bool is_own_body(const std::string& model) const;
    [[nodiscard]] std::string own_body(const sim::PoseLine& line, std::string_view robot) const;
    void tell_of(const sim::PoseLine& line, std::string_view robot, sim::Time time);

    MqttLink& link_;
    const std::string name_;
    World& world_;
    PoseIntake& intake_;
    const Clock& clock_;
    /// The bodies of the robots here, by the names of these; empty where one has none.
    std::map<std::string, std::string, std::less<>> bodies_;
    std::optional<Nearness> nearness_;
    boost::asio::steady_timer timer_;
    std::map<std::string, Vehicle> vehicles_;  ///< by the topics of their states
    PoseSender sender_;
    PoseReceiver receiver_;
    std::optional<SharedTime> time_;  ///< in lockstep
};

}  // namespace scipd::daemon
