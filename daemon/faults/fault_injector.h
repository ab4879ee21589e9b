// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The faults of one scanner: begins and ends each when it is due, lets the active ones act, and
// keeps the log. While it has no fault it is nowhere: no layer has a hook. Lives on its shard.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "daemon/clock/clock.h"
#include "daemon/device/device.h"
#include "daemon/device/device_hook.h"
#include "daemon/faults/device_condition.h"
#include "daemon/faults/device_site.h"
#include "daemon/faults/fault_log.h"
#include "daemon/faults/fault_plan.h"
#include "daemon/faults/fault_run.h"
#include "daemon/link/line_hook.h"
#include "daemon/link/port.h"

namespace scipd::daemon {

class FaultInjector : private DeviceHook, private LineHook {
  public:
    /// The ports reach the device over a line like `link`. All must outlive it.
    FaultInjector(Device& device, std::vector<Port*> ports, const LinkConfig& link, Clock& clock);
    FaultInjector(const FaultInjector&) = delete;
    FaultInjector& operator=(const FaultInjector&) = delete;
    /// As stop_all().
    ~FaultInjector() override;

    /// Asks for a fault and returns its id, from 1. `seed`: of a plan that has none. `step`: of a
    /// scenario, from 1.
    std::uint64_t start(FaultPlan plan, std::uint64_t seed, std::optional<int> step = {});
    /// Ends a fault and forgets it. False: there is none of this id.
    bool stop(std::uint64_t id);
    void stop_all();

    /// Those that wait, act, or have lately ended, the oldest first.
    [[nodiscard]] std::vector<FaultStatus> list() const;
    [[nodiscard]] FaultLog& log() { return site_.log; }
    [[nodiscard]] const FaultLog& log() const { return site_.log; }

  private:
    // SessionHook
    std::optional<protocol::Status> refuse(const protocol::Request& request) override;
    std::vector<protocol::Send> leave(const protocol::Session& from,
                                      protocol::Send message) override;
    void forget(const protocol::Session& session) override;
    // DeviceHook
    void turn(std::int64_t revolution) override;
    bool serves(std::int64_t revolution) override;
    std::vector<ReadingFault> read(sim::Scan& scan, const sim::SensorSpec& optics) override;
    void booted() override;
    // LineHook
    void leaving(protocol::Send& message) override;
    void connected(Port& port) override;

    [[nodiscard]] FaultMoment moment() const;
    void look_at(const FaultMoment& now);
    /// What is looked at is this message.
    void look_at(const protocol::Send& message, std::uint64_t& replies);
    /// Begins and ends what is due at the moment that is looked at.
    void advance();
    /// Does what has begun or ended, outside of all calls of the device and the ports.
    void settle();
    void settle_soon();
    void set_clock();
    /// Sets lines, poses and the device as all acting effects have them.
    void compose();
    /// Takes the hooks away that nobody needs, and forgets faults that ended long ago.
    void tidy();
    void wait();
    [[nodiscard]] std::optional<sim::Time> next_look(const FaultSchedule& schedule) const;
    [[nodiscard]] bool idle() const;

    template <class Act>
    void each_acting(Act act);

    LinkConfig link_;
    Clock& clock_;
    DeviceSite site_;
    std::vector<std::unique_ptr<FaultRun>> runs_;
    std::uint64_t last_id_ = 0;
    bool hooked_ = false;
    std::uint64_t replies_ = 0;  ///< that left sessions, and ports, since the first fault
    std::uint64_t replies_sent_ = 0;
    FaultedDevice condition_;
    LineState line_;
    PoseShift shift_;
    std::unique_ptr<Clock::Alarm> alarm_;      ///< for what begins, and ends, on the way
    std::unique_ptr<Clock::Alarm> end_alarm_;  ///< for what a driver waits for
    std::unique_ptr<Clock::Alarm> soon_;
};

}  // namespace scipd::daemon
