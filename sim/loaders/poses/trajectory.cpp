// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/poses/trajectory.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "sim/loaders/load_error.h"
#include "sim/loaders/plain_file.h"
#include "sim/loaders/poses/tum_line.h"

namespace scipd::sim {
namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// Past this many faults a file is not a trajectory at all, and a list of them helps nobody.
constexpr std::size_t fault_limit = 100;

/// A week of a hundred poses a second is half of this.
constexpr std::uintmax_t largest_file = 1U << 30U;

using Seconds = std::chrono::duration<double>;

/// Twice as much still fits into a Time.
constexpr Seconds longest{4.5e9};

class TumReader {
  public:
    explicit TumReader(const std::filesystem::path& file) : file_(file.string()) {}

    void read_line(std::string_view line) {
        ++line_number_;
        if (says_nothing(line)) return;
        auto parsed = parse_tum_line(line);
        if (auto* refusal = std::get_if<std::string>(&parsed)) {
            return add_fault(*refusal);
        }
        append(std::get<TimedPose>(parsed));
    }

    std::vector<TimedPose> finish() && {
        if (fault_count_ > fault_limit) {
            faults_.push_back(file_ + ": and " + std::to_string(fault_count_ - fault_limit) +
                              " more");
        }
        if (poses_.empty() && faults_.empty()) {
            faults_.push_back(file_ + ": holds no pose; a line is t tx ty tz qx qy qz qw");
        }
        if (!faults_.empty()) throw LoadError(std::move(faults_));
        return std::move(poses_);
    }

  private:
    void append(const TimedPose& next) {
        if (!poses_.empty() && next.time <= poses_.back().time) {
            return add_fault("t must be later than the pose before it");
        }
        // In floating point: they may lie farther apart than a Time can tell.
        if (!poses_.empty() && Seconds(next.time) - Seconds(poses_.front().time) > longest) {
            return add_fault("t must lie within 4.5e9 s of the first one");
        }
        poses_.push_back(next);
    }

    void add_fault(const std::string& text) {
        if (++fault_count_ > fault_limit) return;
        faults_.push_back(file_ + ':' + std::to_string(line_number_) + ": " + text);
    }

    std::string file_;
    std::size_t line_number_ = 0;
    std::size_t fault_count_ = 0;
    std::vector<std::string> faults_;
    std::vector<TimedPose> poses_;
};

}  // namespace

std::vector<TimedPose> load_tum(const std::filesystem::path& file) {
    return parse_tum(read_file(file, largest_file, "name a TUM trajectory"), file);
}

Time lap_time(const std::vector<TimedPose>& poses) {
    if (poses.size() < 2) return {};
    const Time last_step = poses.back().time - poses[poses.size() - 2].time;
    return poses.back().time - poses.front().time + last_step;
}

std::vector<TimedPose> parse_tum(std::string_view text, const std::filesystem::path& file) {
    std::string_view rest = text;
    if (rest.starts_with(byte_order_mark)) rest.remove_prefix(byte_order_mark.size());
    TumReader reader{file};
    while (!rest.empty()) {
        const auto end = std::min(rest.find('\n'), rest.size());
        reader.read_line(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return std::move(reader).finish();
}

}  // namespace scipd::sim
