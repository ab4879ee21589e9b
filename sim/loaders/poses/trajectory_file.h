// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads a trajectory from a file of one of the formats in trajectory.h, in metres. A line that
// begins with # is a comment. Stamps are read as integers of nanoseconds, since a double near
// 1.7e9 s has a step of 238 ns. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "sim/loaders/poses/trajectory.h"
#include "sim/time.h"

namespace scipd::sim {

/// `times` is the file with the stamps of a KITTI file, one a line. Where it is empty, times.txt
/// beside the KITTI file is read, if there is one. Throws LoadError with every fault.
Trajectory load_trajectory(const std::filesystem::path& file,
                           TrajectoryFormat format = TrajectoryFormat::guess,
                           const std::filesystem::path& times = {});

/// The stamps of a KITTI file.
struct Stamps {
    std::filesystem::path file;
    std::vector<Time> times;  ///< none is earlier than the one before it
};

/// One stamp a line; comments and empty lines are skipped. Throws LoadError at the first line that
/// is wrong.
Stamps parse_stamps(std::string_view text, const std::filesystem::path& file);

/// Reads a text as load_trajectory() does a file; `file` names it in faults. A KITTI file without
/// stamps has 10 poses a second.
Trajectory parse_trajectory(std::string_view text, const std::filesystem::path& file,
                            TrajectoryFormat format = TrajectoryFormat::guess,
                            const std::optional<Stamps>& stamps = {});

/// The format that the file's first lines look like.
TrajectoryFormat guessed_format(std::string_view text);
TrajectoryFormat format_of(const std::filesystem::path& file);

}  // namespace scipd::sim
