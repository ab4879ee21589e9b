// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "testing/tum_drive.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <sstream>
#include <string>

#include "testing/pose_json.h"

namespace scipd::testing {
namespace {

/// t tx ty tz qx qy qz qw. False: the line is another one.
bool read(const std::string& line, std::array<double, 8>& numbers) {
    std::istringstream words(line);
    for (double& number : numbers)
        words >> number;
    return words && (words >> std::ws).eof();
}

}  // namespace

TumDrive::TumDrive(const std::filesystem::path& path) {
    std::ifstream file(path);
    if (!file) throw ScipdError(path.string() + " cannot be read");
    const auto refuse = [&](std::size_t number, const std::string& why) -> ScipdError {
        return ScipdError{path.string() + ":" + std::to_string(number) + ": " + why};
    };
    double first_s = 0;
    std::string line;
    for (std::size_t number = 1; std::getline(file, line); ++number) {
        if (const auto text = line.find_first_not_of(" \t\r");
            text == line.npos || line[text] == '#')
            continue;
        std::array<double, 8> is{};
        if (!read(line, is))
            throw refuse(number,
                         "is no line of TUM (t tx ty tz qx qy qz qw), the only format that "
                         "is read here; scipctl pose play reads others");
        if (knots_.empty()) first_s = is[0];
        const double time_s = is[0] - first_s;
        if (!knots_.empty() && time_s <= knots_.back().time_s)
            throw refuse(number, "the times of a drive must grow");
        knots_.push_back(
            {time_s, {{"xyz", {is[1], is[2], is[3]}}, {"q", {is[4], is[5], is[6], is[7]}}}});
    }
    if (knots_.empty()) throw ScipdError(path.string() + ": holds no pose");
}

Json TumDrive::pose_at(double time_s) const {
    const auto after = std::ranges::upper_bound(knots_, time_s, {}, &Knot::time_s);
    if (after == knots_.begin()) return knots_.front().pose;
    if (after == knots_.end()) return knots_.back().pose;
    const Knot& before = *(after - 1);
    return between(before.pose, after->pose,
                   (time_s - before.time_s) / (after->time_s - before.time_s));
}

}  // namespace scipd::testing
