// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a user wants to run, however it was said: a YAML file or command-line options. Plain values,
// complete and checked: names are unique, models and backends exist, files that a configuration
// names can be opened by the paths here. Nothing has been opened or bound yet.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "daemon/config/sensor_config.h"
#include "sim/loaders/map/ros_map.h"
#include "sim/loaders/poses/trajectory_format.h"
#include "sim/loaders/sdf/sdf.h"
#include "sim/world/pose_track.h"

namespace scipd::daemon {

/// Where a robot's live poses come from.
struct PoseSource {
    enum class Kind { udp, file, standard_input };
    Kind kind = Kind::udp;
    Address address;             ///< of udp
    std::filesystem::path file;  ///< a trajectory; its first stamp is the start of the daemon
    sim::TrajectoryFormat format = sim::TrajectoryFormat::guess;
    std::filesystem::path times = {};  ///< of a KITTI trajectory; empty: beside it, or 10 Hz
    double speed = 1.0;  ///< of a trajectory: how much faster than its stamps it is played
    bool loop = false;   ///< of a trajectory: begins anew where it has ended

    bool operator==(const PoseSource&) const = default;
};

struct RobotConfig {
    std::string name;
    sim::Pose world_from_robot;  ///< at the start
    bool pose_given = false;     ///< else a named mount may give it another start
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

/// What a world may take; one model that is added, an eighth of the memory and a tenth of the
/// triangles.
struct WorldLimits {
    std::size_t memory_bytes = std::size_t{4} << 30U;  ///< limits.h
    std::size_t triangles = 20'000'000;
    std::chrono::seconds load_time = std::chrono::minutes{10};

    bool operator==(const WorldLimits&) const = default;
};

struct Config {
    std::filesystem::path scene;
    sim::SdfGeometry geometry = sim::SdfGeometry::visual;
    bool strict = false;  ///< what is warned of in a world or a trajectory is a fault
    sim::MapOptions map;
    WorldLimits limits;
    ClockKind clock = ClockKind::wall;
    std::uint64_t seed = 1;
    std::vector<RobotConfig> robots;
    std::filesystem::path control;  ///< empty: control.sock in the run directory
    std::optional<Address> http;
    /// By key, where it stands, "FILE:LINE: KEY: ": of those whose faults only show in other files.
    std::map<std::string, std::string> places;

    /// Empty: nobody knows, as of what options say.
    [[nodiscard]] std::string place_of(const std::string& key) const {
        const auto found = places.find(key);
        return found == places.end() ? std::string{} : found->second;
    }

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
