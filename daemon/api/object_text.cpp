// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/object_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace scipd::daemon {

ObjectText::ObjectText(const Json& members) : text_(text_of(members)) {
    text_.pop_back();
}

void ObjectText::add(std::string_view name, const Json& value) {
    begin(name);
    text_ += text_of(value);
}

void ObjectText::begin(std::string_view name) {
    if (text_.size() > 1) text_ += ',';
    text_.append(1, '"').append(name).append("\":");
}

std::string ObjectText::finish() && {
    text_ += '}';
    return std::move(text_);
}

void append_number(std::string& text, double value) {
    std::array<char, 32> digits{};
    char* const end = std::to_chars(digits.begin(), digits.end(), value).ptr;
    text.append(digits.begin(), end);
    if (std::string_view(digits.begin(), end).find_first_of(".e") == std::string_view::npos)
        text += ".0";
}

void append_pose(std::string& text, const sim::Pose& pose) {
    const auto append = [&](std::string_view before, double value) {
        append_number(text += before, value);
    };
    const auto& [xyz_m, q] = pose;
    append(R"({"xyz":[)", xyz_m.x);
    append(",", xyz_m.y);
    append(",", xyz_m.z);
    append(R"(],"q":[)", q.x);
    append(",", q.y);
    append(",", q.z);
    append(",", q.w);
    text += "]}";
}

void append_timed_pose(std::string& text, double time_s, const sim::Pose& pose) {
    append_number(text += R"({"time_s":)", time_s);
    const std::size_t end = text.size();
    append_pose(text, pose);
    text[end] = ',';  // the pose goes on with the object
}

// Digits of whole millionths take a quarter of the time of the shortest text of a double, and of so
// few digits that is the same.
void append_rounded(std::string& text, double value) {
    constexpr double per_unit = 1e6;
    constexpr std::int64_t one = 1'000'000;
    constexpr double most = 1e9;  // a double has no more millionths
    if (!std::isfinite(value)) return void(text += "null");
    if (std::abs(value) >= most) return void(text += text_of(rounded(value)));
    const std::int64_t millionths = std::llround(std::abs(value) * per_unit);
    std::array<char, 24> digits{};
    char* const point = std::to_chars(digits.begin(), digits.end(), millionths / one).ptr;
    // The one before the millionths keeps their zeros; then the point takes its place.
    char* end = std::to_chars(point, digits.end(), one + millionths % one).ptr;
    *point = '.';
    while (end[-1] == '0' && end[-2] != '.')
        --end;
    if (value < 0.0) text += '-';
    text.append(digits.begin(), end);
}

}  // namespace scipd::daemon
