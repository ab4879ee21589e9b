// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a user wants to run, said by a YAML file (config_file.h) or by command-line options. Plain
// values, complete and checked: names are unique, models and backends exist, and the paths here
// lead to the files that a configuration names. Nothing has been opened or bound yet.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "daemon/config/fleet_config.h"
#include "daemon/config/sensor_config.h"
#include "daemon/limits/limit.h"
#include "sim/loaders/map/map_options.h"
#include "sim/loaders/poses/trajectory.h"
#include "sim/loaders/sdf/sdf_options.h"
#include "sim/world/medium.h"
#include "sim/world/pose_track.h"

namespace scipd::daemon {

/// Which frame of ROS the robot is, and in which one it moves; empty: not said.
struct RosFrames {
    std::string parent = {};
    std::string child = {};

    bool operator==(const RosFrames&) const = default;
};

/// Where a robot's live poses come from.
struct PoseSource {
    enum class Kind { udp, file, standard_input, vda5050, gz, ros2, rosbridge };
    Kind kind = Kind::udp;
    Address address;             ///< of udp; of rosbridge, whose host may be a name
    std::filesystem::path file;  ///< a trajectory; its first stamp is the start of the daemon
    sim::TrajectoryFormat format = sim::TrajectoryFormat::guess;
    std::filesystem::path times = {};  ///< of a KITTI trajectory; empty: beside it, or 10 Hz
    double speed = 1.0;  ///< of a trajectory: how much faster than its stamps it is played
    bool loop = false;   ///< of a trajectory: begins anew where it has ended
    /// For vda5050: MANUFACTURER/SERIAL, or MANUFACTURER of one that is called as the robot is.
    std::string vehicle = {};
    std::string topic =
        {};  ///< of gz, ros2 or rosbridge; empty: that of gz for the world which is loaded
    std::string called = {};  ///< what gz calls the robot; empty: as its body, else as itself
    RosFrames frames = {};    ///< of ros2 or rosbridge

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
    poses,  ///< the stamps of the pose streams; time stands still between them
};

/// How much a world may take. A model that is added later may take an eighth of the memory and a
/// tenth of the triangles.
struct WorldLimits {
    std::size_t memory_bytes = std::size_t{4} << 30U;  ///< world_options.h
    std::size_t triangles = 20'000'000;
    std::size_t overlap = 1000;  ///< triangles that a ray may be tested against in one place
    std::chrono::seconds load_time = std::chrono::minutes{10};

    bool operator==(const WorldLimits&) const = default;
};

struct Config {
    std::filesystem::path scene;
    sim::SdfGeometry geometry = sim::SdfGeometry::visual;
    sim::XacroArguments xacro;
    bool strict = false;  ///< what a world or a trajectory would cause a warning for is a fault
    sim::MapOptions map;
    std::filesystem::path materials;  ///< what they say comes before the stock library; empty: none
    std::vector<sim::Medium> media;   ///< what fills the air at the start
    std::filesystem::path scenario;   ///< what goes wrong; empty: nothing
    WorldLimits limits;
    LimitValues client_limits;  ///< of the same section
    ClockKind clock = ClockKind::wall;
    std::uint64_t seed = 1;
    std::vector<RobotConfig> robots;
    std::filesystem::path control;          ///< empty: control.sock in the run directory
    std::optional<unsigned> control_group;  ///< who may use it besides its owner, by number
    std::optional<Address> http;
    std::string http_token;                    ///< that its clients must know; empty: none
    std::vector<std::filesystem::path> allow;  ///< folders of files that its clients may name
    std::optional<FleetConfig> fleet;          ///< nothing: the world is this daemon's alone
    /// What looks wrong and is taken as it is, each with its place.
    std::vector<std::string> warnings;
    std::filesystem::path file;  ///< that it was read from; empty: options say it
    std::string document;        ///< what the file says
    /// Where a key stands, "FILE:LINE: KEY: ", for the keys whose faults show only when other files
    /// have been read.
    std::map<std::string, std::string> places;

    /// Whether materials and media change what any sensor reads.
    [[nodiscard]] bool any_sees_light() const {
        return std::ranges::any_of(robots, [](const RobotConfig& robot) {
            return std::ranges::any_of(robot.sensors, &SensorConfig::sees_light);
        });
    }

    /// Whether all sensors play recordings, so that nobody needs a world.
    [[nodiscard]] bool only_plays() const {
        return std::ranges::all_of(robots, [](const RobotConfig& robot) {
            return std::ranges::all_of(robot.sensors, [](const SensorConfig& sensor) {
                return sensor.replay.has_value();
            });
        });
    }

    /// Where the key stands; empty where that is unknown, as for command-line options.
    [[nodiscard]] std::string place_of(const std::string& key) const {
        const auto found = places.find(key);
        return found == places.end() ? std::string{} : found->second;
    }

    bool operator==(const Config&) const = default;
};

}  // namespace scipd::daemon
