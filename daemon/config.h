// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a user wants to run, however it was said: a YAML file or command-line options. Plain values,
// complete and checked: names are unique, models and backends exist, files that a configuration
// names can be opened by the paths here. Nothing has been opened or bound yet.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "daemon/models/model.h"
#include "sim/sensor/error_model.h"
#include "sim/world/pose.h"
#include "sim/world/pose_track.h"

namespace scipd::daemon {

/// Where to listen; port 0 takes a free one.
struct Address {
    std::string host;
    std::uint16_t port = 0;

    bool operator==(const Address&) const = default;
};

/// "auto" of the user is an empty link: one in the run directory.
struct PtyConfig {
    std::filesystem::path link;

    bool operator==(const PtyConfig&) const = default;
};

enum class Timing {
    real,   ///< replies and scans leave on the grid of the firmware
    ideal,  ///< at once
};

/// How the daemon finds the device.
enum class PowerUp {
    scip2,  ///< powered and booted
    scip1,  ///< the same, in SCIP 1.1: only models that spoke it
    boot,   ///< just switched on: its boot time has begun
};

/// The device's own clock.
struct DeviceClockConfig {
    double ppm = 0.0;            ///< how much too fast it runs
    std::uint32_t start_ms = 0;  ///< what it shows at the start

    bool operator==(const DeviceClockConfig&) const = default;
};

/// What lies between the device and its client.
struct LinkConfig {
    /// Each way, on every message; and by how much it varies, evenly, to either side.
    std::chrono::nanoseconds latency{};
    std::chrono::nanoseconds jitter{};
    /// The tty is a serial line that starts at this rate; nothing: USB, whose rate means nothing.
    std::optional<int> baud;
    /// Messages leave in pieces of at most so many bytes, each in a write of its own; 0: whole.
    int split_bytes = 0;
    /// What is sent within so long leaves in one write.
    std::chrono::nanoseconds coalesce{};
    /// A tty's close ends the streams that were begun on it; else they go on unheard.
    bool stop_on_close = false;

    bool operator==(const LinkConfig&) const = default;
};

struct SensorConfig {
    std::string name;  ///< of the sensor alone: "front"
    Model model;       ///< with what the configuration overrides
    sim::Pose robot_from_sensor;
    std::optional<Address> tcp;
    std::optional<PtyConfig> pty;
    std::string backend = "auto";
    sim::Accuracy accuracy = sim::Accuracy::sensor;
    /// Poses per sweep; nothing: one for each beam.
    std::optional<int> motion;
    Timing timing = Timing::real;
    PowerUp power_up = PowerUp::scip2;
    DeviceClockConfig clock;
    LinkConfig link;
    /// How long its scans wait for poses that are late.
    std::chrono::nanoseconds wait_for_poses{};
    bool sees_body = false;  ///< the robot's own body stands in its way too

    bool operator==(const SensorConfig&) const = default;
};

/// Where a robot's live poses come from.
struct PoseSource {
    enum class Kind { udp, file, standard_input };
    Kind kind = Kind::udp;
    Address address;             ///< of udp
    std::filesystem::path file;  ///< a TUM trajectory; its first stamp is the start of the daemon
    double speed = 1.0;          ///< of a trajectory: how much faster than its stamps it is played
    bool loop = false;           ///< of a trajectory: begins anew where it has ended

    bool operator==(const PoseSource&) const = default;
};

struct RobotConfig {
    std::string name;
    sim::Pose world_from_robot;  ///< at the start
    std::string body;            ///< the scene's movable model that moves with it; empty: none
    std::optional<PoseSource> poses;
    sim::PosePolicy policy;
    std::vector<SensorConfig> sensors;

    bool operator==(const RobotConfig&) const = default;
};

/// What time is.
enum class ClockKind {
    wall,
    poses,  ///< the stamps of the pose streams: it stands still between them
};

struct Config {
    std::filesystem::path scene;
    ClockKind clock = ClockKind::wall;
    std::uint64_t seed = 1;
    std::vector<RobotConfig> robots;
    std::filesystem::path control;  ///< empty: control.sock in the run directory
    std::optional<Address> http;

    bool operator==(const Config&) const = default;
};

/// Everything that is wrong with a configuration, at once: one fault a line, each with FILE:LINE:
/// KEY: what to do.
class ConfigError : public std::runtime_error {
  public:
    explicit ConfigError(std::vector<std::string> faults);
    [[nodiscard]] const std::vector<std::string>& faults() const { return faults_; }

  private:
    std::vector<std::string> faults_;
};

/// Throws ConfigError. Paths in the result are absolute; in the file they are relative to it.
Config load_config(const std::filesystem::path& file);

/// The same from text; `file` names it in faults and is what paths are relative to.
Config parse_config(const std::string& text, const std::filesystem::path& file);

}  // namespace scipd::daemon
