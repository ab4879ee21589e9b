// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/fleet/step.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <system_error>

namespace scipd::daemon {
namespace {

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
