// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Any bytes as a trajectory, read as the format that they look like and as every other: the result
// is poses that can be played, or faults that can be shown.
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "sim/loaders/file/load_error.h"
#include "sim/loaders/poses/trajectory_file.h"
#include "sim/text/quote.h"

namespace {

using namespace scipd::sim;

void require(bool holds) {
    if (!holds) std::abort();
}

void check(const std::vector<TimedPose>& poses) {
    require(!poses.empty());
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const auto& [time, pose] = poses[i];
        require(i == 0 || time > poses[i - 1].time);
        // Twice the time, as players use it when they go back to the beginning: a sanitizer sees an
        // overflow.
        const Time since_first = time - poses.front().time;
        require(since_first + since_first >= Time{});
        const auto& p = pose.translation_m;
        require(std::abs(p.x) <= 1e7 && std::abs(p.y) <= 1e7 && std::abs(p.z) <= 1e7);
        require(std::abs(glm::length(pose.rotation) - 1.0) < 1e-9);
    }
}

void check(const std::string& sentence) {
    require(sentence.starts_with("walk:") && sentence.size() < 500);
    require(scipd::sim::printable(sentence, sentence.size()) == sentence);
}

void check(const LoadError& error) {
    require(!error.faults().empty() && error.faults().size() <= 101);
    for (const auto& fault : error.faults())
        check(fault);
}

void read_as(TrajectoryFormat format, std::string_view text) {
    try {
        const Trajectory trajectory = parse_trajectory(text, "walk", format);
        check(trajectory.poses);
        require(trajectory.warnings.size() <= 2);
        for (const auto& warning : trajectory.warnings)
            check(warning);
    } catch (const LoadError& error) {
        check(error);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using Format = TrajectoryFormat;
    const std::string_view text{reinterpret_cast<const char*>(data), size};
    for (const Format format :
         {Format::guess, Format::tum, Format::euroc, Format::kitti, Format::csv}) {
        read_as(format, text);
    }
    return 0;
}
