// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/plan/load_trajectories.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <tuple>
#include <utility>

#include "daemon/plan/load_world.h"
#include "sim/loaders/file/load_error.h"

namespace scipd::daemon {
namespace {

/// Reads each file once, whoever plays it and how fast.
class Reader {
  public:
    explicit Reader(bool strict) : strict_(strict) {}

    PlayedPoses read(const PoseSource& source) {
        PlayedPoses& poses = read_[{source.file, source.format, source.times}];
        if (!poses) {
            ReadTrajectory read = read_trajectory(source);
            if (strict_ && !read.warnings.empty()) throw sim::LoadError(std::move(read.warnings));
            std::ranges::move(read.warnings, std::back_inserter(warnings));
            poses = std::move(read.poses);
        }
        check_speed(source, *poses);
        return poses;
    }

    std::vector<std::string> warnings;

  private:
    using File = std::tuple<std::filesystem::path, sim::TrajectoryFormat, std::filesystem::path>;

    bool strict_;
    std::map<File, PlayedPoses> read_;
};

bool is_played(const RobotConfig& robot, const PlayedSources& played) {
    const auto found = played.find(robot.name);
    return found != played.end() && found->second == *robot.poses;
}

}  // namespace

LoadedTrajectories load_trajectories(const Config& config, const PlayedSources& played,
                                     const std::stop_token& stop) {
    LoadedTrajectories loaded;
    Reader reader(config.strict);
    std::vector<std::string> faults;
    for (const RobotConfig& robot : config.robots) {
        if (!robot.poses || robot.poses->kind != PoseSource::Kind::file) continue;
        if (is_played(robot, played)) continue;
        if (stop.stop_requested()) throw sim::LoadError({"scipd ends"});
        try {
            loaded.poses[robot.name] = reader.read(*robot.poses);
        } catch (const sim::LoadError& error) {
            const std::string place = config.place_of("robots." + robot.name + ".poses");
            const sim::LoadError placed = named_at(place, error);
            std::ranges::copy(placed.faults(), std::back_inserter(faults));
        }
    }
    if (!faults.empty()) throw sim::LoadError(std::move(faults));
    loaded.warnings = std::move(reader.warnings);
    return loaded;
}

}  // namespace scipd::daemon
