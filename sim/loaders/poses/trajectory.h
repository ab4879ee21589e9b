// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Poses as text, in metres. # begins a comment, and stamps are read as integers of nanoseconds,
// since a double near 1.7e9 s has a step of 238 ns. A trajectory is a file of one of the forms of
// trajectory_format.h. A pose line is one JSON object or one TUM line, as it comes from a file,
// stdin or a datagram. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sim/loaders/poses/trajectory_format.h"
#include "sim/time.h"
#include "sim/world/pose.h"

namespace scipd::sim {

struct TimedPose {
    Time time{};  ///< on the sender's clock
    Pose pose;
};

struct Trajectory {
    std::vector<TimedPose> poses;  ///< stamps strictly growing, within 4.5e9 s
    std::vector<std::string> warnings;
};

/// `times` has the stamps of a KITTI file, a line each; empty: times.txt beside it, where there is
/// one. Throws LoadError with every fault.
Trajectory load_trajectory(const std::filesystem::path& file,
                           TrajectoryFormat format = TrajectoryFormat::guess,
                           const std::filesystem::path& times = {});

/// Those of a KITTI file.
struct Stamps {
    std::filesystem::path file;
    std::vector<Time> times;  ///< none before the one before it
};

/// Of each of the lines that say something. Throws LoadError at the first that is wrong.
Stamps parse_stamps(std::string_view text, const std::filesystem::path& file);

/// The same of a text that is there already; `file` names it in faults. No stamps: 10 Hz.
Trajectory parse_trajectory(std::string_view text, const std::filesystem::path& file,
                            TrajectoryFormat format = TrajectoryFormat::guess,
                            const std::optional<Stamps>& stamps = {});

/// What the file's first lines look like.
TrajectoryFormat guessed_format(std::string_view text);

/// Of a loop, from its first pose to the same one of the next lap: the way back takes as long as
/// the last step. Nothing where there is but one pose, which makes no loop.
Time lap_time(const std::vector<TimedPose>& poses);

/// What a pose line says. At most one of `robot` and `model` is set; neither: the only robot.
struct PoseLine {
    std::string robot;
    std::string model;
    std::optional<Time> time;
    Pose pose;
    std::optional<Velocity> velocity;
};

/// Whether a line is empty or a comment, and so neither a pose nor damaged: readers of streams skip
/// those, to parse_pose_line() they are refusals.
bool says_nothing(std::string_view line);

/// The line, or why it is refused: a sentence that names the field. Never throws on any bytes.
std::variant<PoseLine, std::string> parse_pose_line(std::string_view line);

}  // namespace scipd::sim
