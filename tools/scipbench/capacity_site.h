// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where a run is measured: a folder with the configuration of its scipd, and the places of its
// robots in the world. One thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/time.h"
#include "sim/world/pose.h"

namespace scipd::tools {

/// What all runs of a measurement have in common.
struct CapacitySetup {
    std::filesystem::path scipd;  ///< the program
    std::filesystem::path scene;
    std::string model = "UST-10LX";
    bool driving = false;
    bool lockstep = false;       ///< time is that of the robots, which drive then
    int moving = 0;              ///< models that move, beside the robots
    std::optional<int> threads;  ///< of scipd; none: as many as it takes by itself
    std::chrono::seconds duration{10};
};

/// In one line.
[[nodiscard]] std::string describe(const CapacitySetup& setup);

/// The scanner above the ground, and above its robot.
inline constexpr double scanner_height_m = 0.3;

/// Where a robot is that goes round in a circle at its place. Robots that stand are there at 0.
[[nodiscard]] sim::Pose on_its_lap(const sim::Pose& place, sim::Time time);
/// Between two poses of a robot that drives.
inline constexpr sim::Time pose_period = std::chrono::milliseconds(20);

class CapacitySite {
  public:
    /// A new folder, which goes with this object.
    CapacitySite();
    CapacitySite(const CapacitySite&) = delete;
    CapacitySite& operator=(const CapacitySite&) = delete;
    ~CapacitySite();

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    [[nodiscard]] std::filesystem::path control() const { return folder_ / "control.sock"; }
    /// Writes the configuration of a robot with one scanner at each place. A robot that drives
    /// follows a file: scipd reads it once, and no program beside the test sends poses.
    void write(const CapacitySetup& setup, const std::vector<sim::Pose>& places) const;
    /// Where scipd takes poses of what moves beside the robots, by UDP at 127.0.0.1.
    [[nodiscard]] std::uint16_t poses_port() const { return poses_port_; }
    [[nodiscard]] std::filesystem::path configuration() const { return folder_ / "rig.yaml"; }

  private:
    std::filesystem::path folder_;
    std::uint16_t poses_port_;
};

}  // namespace scipd::tools
