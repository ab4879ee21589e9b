// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// When one fault begins and ends, by scans, by the time and by requests. It waits for nothing and
// touches nothing: who asks it hands the moment in. One thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "daemon/faults/fault_plan.h"
#include "sim/time.h"

namespace scipd::daemon {

/// One instant of a scanner.
struct FaultMoment {
    std::int64_t scan = 0;  ///< the latest one that was served
    bool serving = false;   ///< it is served at this instant
    sim::Time time{};
    sim::Time origin{};  ///< what people call world time 0

    /// The first scan that is still to be changed.
    [[nodiscard]] std::int64_t next_scan() const { return serving ? scan : scan + 1; }
};

class FaultSchedule {
  public:
    enum class Phase { waiting, active, ended };

    /// `seed` decides how much earlier or later each repetition begins.
    FaultSchedule(const FaultPlan& plan, std::uint64_t seed, const FaultMoment& asked);

    [[nodiscard]] Phase phase() const { return phase_; }
    /// Whether it is to begin now; only while it waits.
    [[nodiscard]] bool due(const FaultMoment& now) const;
    /// Whether it is to end now; only while it is active.
    [[nodiscard]] bool over(const FaultMoment& now) const;
    /// A request of this code is looked at. Whether it begins with that; to be asked once each.
    [[nodiscard]] bool begins_with(std::string_view command);
    /// Whether it ends with a request of this code.
    [[nodiscard]] bool ends_with(std::string_view command) const;
    [[nodiscard]] bool ends_with_boot() const { return ends_with("RB"); }

    void begin(const FaultMoment& now);
    /// It waits for its next repetition, or is ended for good.
    void end(const FaultMoment& now);

    /// It is ended for good.
    void stop() { phase_ = Phase::ended; }

    /// What it waits for, unless that is a request.
    [[nodiscard]] std::optional<std::int64_t> next_scan() const;
    [[nodiscard]] std::optional<sim::Time> next_time(sim::Time origin) const;

  private:
    /// Its start or its repetition, whichever it waits for.
    void wait_for_repetition(const FaultMoment& now);

    FaultStart start_;
    FaultEnd end_;
    FaultRepetition every_;
    std::uint64_t seed_;
    bool momentary_;
    FaultMoment asked_;
    Phase phase_ = Phase::waiting;
    std::int64_t repetition_ = 0;  ///< the one that it waits for, from 1; 0: none
    int requests_left_ = 0;
    std::int64_t first_scan_ = 0;  ///< that it changes, since it has begun
    sim::Time begun_{};
};

}  // namespace scipd::daemon
