// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A trajectory while its file is read line by line: the poses so far and every fault, so that a
// user sees all faults at once. It knows no format. Any thread; one owner.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/loaders/poses/trajectory.h"

namespace scipd::sim {

/// Half of what a Time can hold.
constexpr std::chrono::duration<double> longest_trajectory{4.5e9};

class TrajectoryDraft {
  public:
    /// Messages begin with the file.
    explicit TrajectoryDraft(const std::filesystem::path& file) : file_(file.string()) {}

    void begin_line() { ++line_number_; }
    /// Leaves the pose out if it has the stamp of the one before it: some recorders write a pose
    /// twice.
    void append(const TimedPose& next);
    /// Adds a fault of this line.
    void add_fault(const std::string& text);
    /// Adds a fault of the whole file.
    void refuse(const std::string& text) { faults_.push_back(file_ + ": " + text); }
    void warn(const std::string& text) { warnings_.push_back(file_ + ": " + text); }

    /// Throws LoadError where anything is wrong or there is no pose. `a_line` shows the user what a
    /// line looks like.
    Trajectory finish(const std::string& a_line) &&;

  private:
    std::string file_;
    std::size_t line_number_ = 0;
    std::size_t fault_count_ = 0;
    std::size_t repeated_count_ = 0;
    std::size_t first_repeated_line_ = 0;
    std::vector<std::string> faults_;
    std::vector<std::string> warnings_;
    std::vector<TimedPose> poses_;
};

}  // namespace scipd::sim
