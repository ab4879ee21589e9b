// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/poses/trajectory_draft.h"

#include <utility>

#include "sim/loaders/file/load_error.h"

namespace scipd::sim {
namespace {

/// Past this many faults a file is not a trajectory at all, and a list of them helps nobody.
constexpr std::size_t fault_limit = 100;

using Seconds = std::chrono::duration<double>;

}  // namespace

void TrajectoryDraft::append(const TimedPose& next) {
    if (!poses_.empty() && next.time == poses_.back().time) {
        if (++repeated_count_ == 1) first_repeated_line_ = line_number_;
        return;
    }
    if (!poses_.empty() && next.time < poses_.back().time) {
        return add_fault("t must be later than the pose before it");
    }
    // In floating point: they may lie farther apart than a Time can tell.
    if (!poses_.empty() && Seconds(next.time) - Seconds(poses_.front().time) > longest_trajectory) {
        return add_fault("t must lie within 4.5e9 s of the first one");
    }
    poses_.push_back(next);
}

void TrajectoryDraft::add_fault(const std::string& text) {
    if (++fault_count_ > fault_limit) return;
    faults_.push_back(file_ + ':' + std::to_string(line_number_) + ": " + text);
}

Trajectory TrajectoryDraft::finish(const std::string& a_line) && {
    if (fault_count_ > fault_limit) {
        faults_.push_back(file_ + ": and " + std::to_string(fault_count_ - fault_limit) + " more");
    }
    if (poses_.empty() && faults_.empty()) {
        faults_.push_back(file_ + ": holds no pose; a line is " + a_line);
    }
    if (!faults_.empty()) throw LoadError(std::move(faults_));
    if (repeated_count_ > 0) {
        warnings_.push_back(
            file_ + ':' + std::to_string(first_repeated_line_) +
            ": has the stamp of the pose before it, as " + std::to_string(repeated_count_) +
            (repeated_count_ == 1 ? " line does" : " lines do") + "; such poses are left out");
    }
    return {std::move(poses_), std::move(warnings_)};
}

}  // namespace scipd::sim
