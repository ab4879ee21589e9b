// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Takes the poses that others send by way of the broker: of this daemon's robots, of models, and of
// the bodies of other daemons' robots. A few lines in a turn of the event loop. Lives on the I/O
// thread.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <boost/asio/any_io_executor.hpp>

#include "daemon/clock/clock.h"
#include "daemon/limits/rate.h"
#include "daemon/limits/throttle.h"
#include "daemon/poses/pose_intake.h"
#include "daemon/world/world.h"
#include "sim/loaders/poses/pose_line.h"

namespace scipd::daemon {

class PoseReceiver {
  public:
    struct Hooks {
        /// The body of a robot that another daemon has; empty: nobody knows of one.
        std::function<std::string(const std::string& robot)> body_of;
        /// Whether a pose matters to this daemon.
        std::function<bool(const sim::PoseLine&)> matters;
        /// A pose of this model was taken.
        std::function<void(const std::string& model)> moved;
    };

    /// `in_steps`: stamps count in steps alone, and other poses hold from when they come.
    PoseReceiver(const boost::asio::any_io_executor& executor, World& world, PoseIntake& intake,
                 const Clock& clock, bool in_steps, Hooks hooks);

    /// The poses of one message.
    void take_frame(std::string_view sender, std::string_view frame);
    /// The poses of one step, all at once. In lockstep.
    void take_step(std::string_view lines, sim::Time time);
    /// Where something stands, said before this daemon was there.
    void take_place(sim::PoseLine line);

    /// While a pose is handed on that came from here: nobody need be told of it.
    [[nodiscard]] bool taking() const { return taking_; }

    [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

  private:
    struct Sender {
        SenderClock clock;
        Rate rate;
    };
    struct Frame {
        Sender* sender;
        std::string text;
        std::size_t taken = 0;
    };

    [[nodiscard]] Sender& sender_of(std::string_view name);
    [[nodiscard]] bool address(sim::PoseLine& line) const;
    void work();
    void take_line(std::string_view text, Sender& sender);
    template <class Take>
    void hand_on(const sim::PoseLine& line, Take take);
    void put(sim::PoseLine line);
    void tell(const std::string& refusal);

    boost::asio::any_io_executor executor_;
    World& world_;
    PoseIntake& intake_;
    const Clock& clock_;
    const bool in_steps_;
    Hooks hooks_;
    std::map<std::string, Sender, std::less<>> senders_;
    std::deque<Frame> frames_;
    std::size_t waiting_bytes_ = 0;
    bool taking_ = false;
    std::uint64_t dropped_ = 0;  ///< frames of which too many came
    Throttle refusals_told_;
    std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);
};

}  // namespace scipd::daemon
