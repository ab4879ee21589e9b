// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A time that many daemons share: it goes on step by step, as whoever leads it says, and this
// daemon says when it has done a step. Lives on the I/O thread, in lockstep.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "daemon/fleet/mqtt_link.h"
#include "daemon/fleet/pose_receiver.h"
#include "daemon/fleet/topics.h"
#include "daemon/limits/throttle.h"
#include "daemon/poses/lockstep.h"
#include "daemon/poses/pose_intake.h"

namespace scipd::daemon {

class SharedTime {
  public:
    /// All must outlive it. `name` is that of this daemon.
    SharedTime(MqttLink& link, const Topics& topics, const std::string& name, Lockstep& lockstep,
               PoseIntake& intake)
        : link_(link),
          ack_(topics.of(Topic::Kind::ack, name)),
          lockstep_(lockstep),
          intake_(intake) {}

    /// From now on time waits for steps.
    void begin() { lockstep_.add(&clock_); }
    void stop() { lockstep_.remove(&clock_); }
    void take(std::string_view text, PoseReceiver& receiver);

  private:
    MqttLink& link_;
    const std::string ack_;
    Lockstep& lockstep_;
    PoseIntake& intake_;
    SenderClock clock_;  ///< of whoever leads time
    Throttle refusals_told_;
    std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);
};

}  // namespace scipd::daemon
