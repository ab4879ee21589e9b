// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipctl/pose_text.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <span>
#include <vector>

#include "sim/text/likely_unit.h"

namespace scipd::tools {
namespace {

/// Roll, pitch and yaw about the fixed axes, in the convention of pose_from_rpy().
glm::dvec3 rpy_rad(const glm::dquat& q) {
    const double sine = std::clamp(2.0 * (q.w * q.y - q.z * q.x), -1.0, 1.0);
    return {std::atan2(2.0 * (q.w * q.x + q.y * q.z), 1.0 - 2.0 * (q.x * q.x + q.y * q.y)),
            std::asin(sine),
            std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))};
}

nlohmann::ordered_json three(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

/// Separated by commas; none where the text is anything else.
std::vector<double> numbers_of(std::string_view text) {
    std::vector<double> numbers;
    const char* place = text.data();
    const char* const end = text.data() + text.size();
    for (;;) {
        double number = 0.0;
        const auto [stop, error] = std::from_chars(place, end, number);
        if (error != std::errc{} || !std::isfinite(number)) return {};
        numbers.push_back(number);
        if (stop == end) return numbers;
        if (*stop != ',') return {};
        place = stop + 1;
    }
}

}  // namespace

std::optional<sim::Pose> parse_pose_text(std::string_view text) {
    const std::vector<double> numbers = numbers_of(text);
    if (numbers.size() == 3) {
        return sim::pose_from_rpy({numbers[0], numbers[1], 0.0}, {0.0, 0.0, numbers[2]});
    }
    if (numbers.size() != 6) return std::nullopt;
    return sim::pose_from_rpy({numbers[0], numbers[1], numbers[2]},
                              {numbers[3], numbers[4], numbers[5]});
}

void warn_of_degrees(std::string_view text) {
    const std::vector<double> numbers = numbers_of(text);
    const std::size_t lengths = numbers.size() == 3 ? 2 : 3;
    if (numbers.size() <= lengths) return;
    if (const auto warning = sim::degrees_for_radians(std::span(numbers).subspan(lengths)))
        std::cerr << "warning: " << *warning << '\n';
}

std::string pose_text(const sim::Pose& pose) {
    const auto& at = pose.translation_m;
    const glm::dvec3 rpy = rpy_rad(pose.rotation);
    char text[160];
    std::snprintf(text, sizeof text, "%.6g,%.6g,%.6g,%.6g,%.6g,%.6g", at.x, at.y, at.z, rpy.x,
                  rpy.y, rpy.z);
    return text;
}

nlohmann::ordered_json pose_body(const sim::PoseLine& line) {
    const auto& q = line.pose.rotation;
    nlohmann::ordered_json body{{"xyz", three(line.pose.translation_m)},
                                {"q", {q.x, q.y, q.z, q.w}}};
    if (line.time) body["t"] = std::chrono::duration<double>(*line.time).count();
    if (line.velocity) {
        body["v"] = three(line.velocity->linear_mps);
        body["w"] = three(line.velocity->angular_radps);
    }
    return body;
}

}  // namespace scipd::tools
