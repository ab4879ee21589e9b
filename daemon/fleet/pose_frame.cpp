// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/fleet/pose_frame.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <utility>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

namespace scipd::daemon {
namespace {

constexpr std::string_view from = "# from ";

std::string quoted(const std::string& name) {
    return nlohmann::json(name).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void append_three(std::string& frame, const char* key, const glm::dvec3& v) {
    fmt::format_to(std::back_inserter(frame), R"(,"{}":[{},{},{}])", key, v.x, v.y, v.z);
}

}  // namespace

std::string frame_head(std::string_view sender) {
    return std::string(from) + std::string(sender) + "\n";
}

std::string_view sender_of(std::string_view frame) {
    if (!frame.starts_with(from)) return {};
    frame.remove_prefix(from.size());
    return frame.substr(0, frame.find_first_of("\r\n"));
}

std::vector<sim::PoseLine> poses_in(std::string_view frame) {
    std::vector<sim::PoseLine> lines;
    while (!frame.empty()) {
        const auto end = std::min(frame.find('\n'), frame.size());
        if (auto line = sim::parse_pose_line(frame.substr(0, end)))
            lines.push_back(*std::move(line));
        frame.remove_prefix(std::min(end + 1, frame.size()));
    }
    return lines;
}

void append_line(std::string& frame, const sim::PoseLine& line) {
    const bool is_model = !line.model.empty();
    fmt::format_to(std::back_inserter(frame), R"({{"{}":{})", is_model ? "model" : "robot",
                   quoted(is_model ? line.model : line.robot));
    if (line.time) {
        const double time_s = std::chrono::duration<double>(*line.time).count();
        fmt::format_to(std::back_inserter(frame), R"(,"t":{})", time_s);
    }
    append_three(frame, "xyz", line.pose.translation_m);
    const glm::dquat& q = line.pose.rotation;
    fmt::format_to(std::back_inserter(frame), R"(,"q":[{},{},{},{}])", q.x, q.y, q.z, q.w);
    if (line.velocity) {
        append_three(frame, "v", line.velocity->linear_mps);
        append_three(frame, "w", line.velocity->angular_radps);
    }
    frame += "}\n";
}

}  // namespace scipd::daemon
