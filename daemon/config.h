// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a user wants to run, however it was said: a YAML file or command-line options. Plain values,
// complete and checked: names are unique, models and backends exist, files that a configuration
// names can be opened by the paths here. Nothing has been opened or bound yet.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/sensor/error_model.h"
#include "sim/world/pose.h"

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

struct SensorConfig {
    std::string name;  ///< of the sensor alone: "front"
    std::string model;
    sim::Pose robot_from_sensor;
    std::optional<Address> tcp;
    std::optional<PtyConfig> pty;
    std::string backend = "auto";
    sim::Accuracy accuracy = sim::Accuracy::sensor;
    /// Poses per sweep; nothing: one for each beam.
    std::optional<int> motion;
    Timing timing = Timing::real;

    bool operator==(const SensorConfig&) const = default;
};

/// Where a robot's live poses come from.
struct PoseSource {
    enum class Kind { udp, file, standard_input };
    Kind kind = Kind::udp;
    Address address;             ///< of udp
    std::filesystem::path file;  ///< a TUM trajectory; its first stamp is the start of the daemon

    bool operator==(const PoseSource&) const = default;
};

struct RobotConfig {
    std::string name;
    sim::Pose world_from_robot;  ///< at the start
    std::optional<PoseSource> poses;
    std::vector<SensorConfig> sensors;

    bool operator==(const RobotConfig&) const = default;
};

struct Config {
    std::filesystem::path scene;
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
