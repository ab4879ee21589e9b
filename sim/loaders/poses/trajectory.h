// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Poses as text. A TUM file: `t tx ty tz qx qy qz qw` a line, seconds and metres, # begins a
// comment; stamps are read as integers of nanoseconds, since a double near 1.7e9 s has a step of
// 238 ns. A pose line: one JSON object or one TUM line, as it comes from a file, stdin or a
// datagram. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sim/time.h"
#include "sim/world/pose.h"

namespace scipd::sim {

struct TimedPose {
    Time time{};  ///< on the sender's clock
    Pose pose;
};

/// Stamps strictly growing, within 4.5e9 s. Throws LoadError with every fault.
std::vector<TimedPose> load_tum(const std::filesystem::path& file);
/// The same of a text that is there already; `file` names it in faults.
std::vector<TimedPose> parse_tum(std::string_view text, const std::filesystem::path& file);

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
