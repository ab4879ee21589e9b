// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What one scanner sees of the world in one revolution: each beam is cast from where the sensor
// is when it is fired, into the world as it is then. Knows no clock, no clients and no wire. Lives
// on its shard.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "daemon/config/config.h"
#include "daemon/config/named_mount.h"
#include "daemon/device/measurement.h"
#include "daemon/world/world.h"
#include "sim/sensor/scanner.h"
#include "sim/time.h"
#include "sim/world/pose.h"

namespace scipd::daemon {

/// Shift by a fault of the poses that a sensor is cast from, against those of its robot.
struct PoseShift {
    std::optional<sim::Pose> stopped;  ///< the robot stays at this pose
    sim::Time late{};                  ///< the robot is where it was so long ago
    sim::Pose jump;  ///< the robot is displaced by this, and turned about itself, in W

    bool operator==(const PoseShift&) const = default;
};

class Sweep {
  public:
    /// World time at which a step is fired.
    using Fired = std::function<sim::Time(int step)>;

    /// `world` must outlive it.
    Sweep(World& world, std::string robot, const SensorConfig& config, sim::Scanner scanner);

    /// sensor_name()
    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] const sim::SensorSpec& optics() const { return scanner_.spec(); }
    [[nodiscard]] sim::Accuracy accuracy() const { return scanner_.accuracy(); }
    /// From now on it sits there.
    void mount(const sim::Pose& robot_from_sensor) {
        robot_from_sensor_ = robot_from_sensor;
        housed_in_.reset();
    }
    [[nodiscard]] bool poses_known(sim::Time until) const { return world_.poses_known(until); }
    /// Whether what it casts depends on no other sensor, and can be cast on any thread.
    [[nodiscard]] bool stands_alone() const {
        return !disturbed_ && !world_.backend(name_).binds_thread();
    }
    /// From now on it reads like this. Its steps and its turn stay.
    void read_as(sim::Scanner scanner, bool disturbed);
    /// From now on it is cast from poses that differ so.
    void shift_poses(const PoseShift& shift) { shift_ = shift; }
    /// Where its robot is at this time.
    [[nodiscard]] sim::Pose robot_at(sim::Time time) const {
        return world_.robot(robot_)->at(time);
    }
    /// The scanner's own lamp does not disturb it.
    void know_own_lamp(const Lamp& lamp) { own_ = &lamp; }
    /// Where its sensor is at this time.
    [[nodiscard]] sim::Pose pose_at(sim::Time time) const;
    /// `origin`: what people call world time 0. `on_for`: since when the sensor is switched on.
    [[nodiscard]] Measurement measure(std::int64_t revolution, sim::Time start, const Fired& fired,
                                      sim::Time origin,
                                      sim::Time on_for = sim::Conditions{}.on_for);

    /// A measurement of this sensor, whoever made it.
    [[nodiscard]] Measurement measurement_of(sim::SharedScan scan, sim::Time origin) const;

  private:
    /// When a beam is fired, counted from the first.
    using BeamFired = std::function<sim::Time(std::size_t beam)>;

    [[nodiscard]] std::size_t beams() const;
    /// How many poses its beams share while it moves.
    [[nodiscard]] std::size_t most_poses() const;
    [[nodiscard]] std::vector<sim::Time> pose_times(const BeamFired& fired) const;
    [[nodiscard]] std::vector<sim::Pose> poses_at(const std::vector<sim::Time>& times) const;
    [[nodiscard]] sim::Pose shifted_pose_at(const sim::PoseTrack& track, sim::Time time) const;
    void cast(sim::Scan& scan, const BeamFired& fired, const sim::Conditions& conditions);
    /// The body, or, for a sensor that sees it, its own housing alone.
    [[nodiscard]] sim::Unseen unseen();
    void cast_as_met(sim::Scan& scan, const BeamFired& fired, const sim::Conditions& conditions,
                     const sim::Unseen& unseen);
    void cast_apart(sim::Scan& scan, const BeamFired& fired, const sim::Conditions& conditions,
                    const sim::Unseen& unseen);
    void cast_in_equal_parts(sim::Scan& scan, const BeamFired& fired,
                             const sim::Conditions& conditions, const sim::Unseen& unseen);
    /// Finds the beams that other scanners disturb.
    void look_at_lamps(sim::Scan& scan, const BeamFired& fired) const;
    void forget_absent(sim::Scan& scan, const BeamFired& fired) const;

    World& world_;
    std::string robot_;
    std::string name_;
    sim::Pose robot_from_sensor_;
    std::optional<int> motion_;
    bool sees_body_;
    std::optional<NamedMount> mount_;
    std::weak_ptr<const sim::Scene> housed_in_;
    std::vector<sim::ObjectId> housing_;  ///< objects of that scene
    bool looks_around_;
    bool disturbed_;  ///< by other scanners
    PoseShift shift_;
    const Lamp* own_ = nullptr;
    sim::Scanner scanner_;
    std::shared_ptr<const sim::SensorSpec> read_with_;  ///< its optics
};

}  // namespace scipd::daemon
