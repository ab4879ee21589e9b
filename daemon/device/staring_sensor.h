// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A camera or a ranger: it speaks no SCIP and is read through the control API. Its instants are a
// period apart; the first is when it was made. It measures only where somebody wants that: a
// subscriber wants every instant, a question the last one. It knows no sockets and does not wait:
// ScanLoop tells it when an instant has come. Lives on its shard.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "daemon/clock/clock.h"
#include "daemon/config/config.h"
#include "daemon/device/pace.h"
#include "daemon/device/scan_source.h"
#include "daemon/device/sensor_counts.h"
#include "daemon/device/sensor_log.h"
#include "daemon/device/sensor_record.h"
#include "daemon/device/sweep.h"
#include "daemon/device/watchers.h"
#include "daemon/world/world.h"
#include "sim/sensor/staring.h"

namespace scipd::daemon {

class StaringSensor : public ScanSource {
  public:
    /// `config` has `staring`. `world` and `clock` must outlive it.
    StaringSensor(const std::string& robot, const SensorConfig& config, std::uint64_t seed,
                  World& world, Clock& clock);

    [[nodiscard]] const sim::StaringSpec& spec() const { return staring_.spec(); }

    /// From the next measurement on it sits there on its robot.
    void mount(const sim::Pose& robot_from_sensor) { sweep_.mount(robot_from_sensor); }

    [[nodiscard]] const std::string& name() const override { return sweep_.name(); }
    /// Drivers need SCIP.
    [[nodiscard]] bool driven() const override { return false; }
    [[nodiscard]] bool watched() const override { return watchers_.any(); }
    void on_wanted(std::function<void()> callback) override { on_wanted_ = std::move(callback); }
    /// Somebody who sees every measurement; null: nobody.
    void watch(Watchers<StaringRecord>::Watcher watcher, WatchedBy who = WatchedBy::stream);

    [[nodiscard]] std::int64_t next_revolution() const override;
    /// At its instant.
    [[nodiscard]] sim::Time leaves(std::int64_t number) const override;
    [[nodiscard]] sim::Time patience() const override { return patience_; }
    [[nodiscard]] bool poses_known(std::int64_t number) const override;
    [[nodiscard]] bool stands_alone() const override { return sweep_.stands_alone(); }
    void turn_complete(std::int64_t number) override;

    /// The measurement of the last instant that need not wait for poses any more. Measures now
    /// where nobody has asked before. Never null.
    SharedStaringRecord latest();
    [[nodiscard]] const StaringLog& log() const { return log_; }
    /// Somebody asks for what log() keeps.
    void ask_log() { log_.ask(clock_.now()); }

    [[nodiscard]] std::uint64_t measured() const { return counts_.scans; }
    [[nodiscard]] const Lateness& lateness() const { return counts_.lateness; }
    [[nodiscard]] const SensorCounts& counts() const { return counts_; }

  private:
    [[nodiscard]] std::int64_t number_at(sim::Time time) const;
    SharedStaringRecord measure(std::int64_t number);
    void note_pace(const StaringRecord& record, sim::Time begin);

    // Constant after construction.
    sim::Staring staring_;
    Sweep sweep_;  ///< but for where it is mounted
    Clock& clock_;
    sim::Time first_;  ///< of the instants
    sim::Time patience_;
    bool rolling_;  ///< its beams are not of one instant

    std::function<void()> on_wanted_;
    Watchers<StaringRecord> watchers_;
    StaringLog log_;
    Pace pace_;
    SensorCounts counts_;
};

}  // namespace scipd::daemon
