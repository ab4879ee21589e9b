// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The faults of one scanner: begins and ends each when it is due, lets the active ones act, and
// keeps the log. While it has no fault it is nowhere: no layer has a hook. Lives on the I/O thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "daemon/clock/clock.h"
#include "daemon/device/device.h"
#include "daemon/device/device_hook.h"
#include "daemon/faults/fault_log.h"
#include "daemon/faults/fault_plan.h"
#include "daemon/link/line_hook.h"
#include "daemon/link/port.h"

namespace scipd::daemon {

class FaultInjector {
  public:
    /// The ports reach the device over a line like `link`. All must outlive it.
    FaultInjector(Device& device, std::vector<Port*> ports, const LinkConfig& link, Clock& clock);
    FaultInjector(const FaultInjector&) = delete;
    FaultInjector& operator=(const FaultInjector&) = delete;
    /// As stop_all().
    ~FaultInjector();

    /// Asks for a fault and returns its id, from 1. `step`: of a scenario, from 1.
    std::uint64_t start(FaultPlan plan, std::uint64_t seed, std::optional<int> step = {});
    /// Ends a fault and forgets it. False: there is none of this id.
    bool stop(std::uint64_t id);
    void stop_all();

    /// Those that wait, act, or have lately ended, the oldest first.
    [[nodiscard]] std::vector<FaultStatus> list() const;
    [[nodiscard]] FaultLog& log() { return log_; }
    [[nodiscard]] const FaultLog& log() const { return log_; }

  private:
    struct Run;

    Device& device_;
    std::vector<Port*> ports_;
    LinkConfig link_;
    Clock& clock_;
    std::vector<std::unique_ptr<Run>> runs_;
    std::uint64_t last_id_ = 0;
    FaultLog log_;
};

}  // namespace scipd::daemon
