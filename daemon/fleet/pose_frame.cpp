// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/fleet/pose_frame.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <iterator>
#include <system_error>
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

/// Takes the word, and the blank or the end behind it, from the beginning of the text.
bool skip(std::string_view& text, std::string_view word) {
    if (!text.starts_with(word)) return false;
    text.remove_prefix(word.size());
    return true;
}

template <class Number>
std::optional<Number> take_number(std::string_view& text) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{}) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return number;
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

// In whole nanoseconds, so that all have the same time to the last digit.
std::string step_head(int number, sim::Time time, std::string_view from) {
    return "# step " + std::to_string(number) + " t_ns " + std::to_string(time.count()) + " from " +
           std::string(from) + "\n";
}

std::optional<Step> parse_step(std::string_view text) {
    const auto end = std::min(text.find('\n'), text.size());
    std::string_view head = text.substr(0, end);
    if (!skip(head, "# step ")) return std::nullopt;
    const auto number = take_number<int>(head);
    if (!number || !skip(head, " t_ns ")) return std::nullopt;
    const auto time_ns = take_number<std::int64_t>(head);
    if (!time_ns || !skip(head, " from ") || head.empty()) return std::nullopt;
    return Step{*number, sim::Time(*time_ns), std::string(head),
                text.substr(std::min(end + 1, text.size()))};
}

std::string acknowledgement(const Step& step) {
    return std::to_string(step.number) + " " + step.from;
}

std::optional<int> acknowledged(std::string_view text, std::string_view leader) {
    const auto number = take_number<int>(text);
    if (!number || !skip(text, " ") || text != leader) return std::nullopt;
    return number;
}

}  // namespace scipd::daemon
