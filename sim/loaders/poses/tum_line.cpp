// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/poses/tum_line.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "sim/loaders/quote.h"
#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

constexpr std::array column_names{"t", "tx", "ty", "tz", "qx", "qy", "qz", "qw"};
constexpr std::string_view blanks = " \t\r\n\v\f";

bool all_digits(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// The power of ten that a stamp ends in, as evo writes it (1.70e+09); 0 where there is none.
/// Nothing where it is no number or would move the point out of any sensible stamp.
std::optional<int> take_exponent(std::string_view& text) {
    const auto e = text.find_first_of("eE");
    if (e == text.npos) return 0;
    std::string_view digits = text.substr(e + 1);
    text = text.substr(0, e);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    int exponent = 0;
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
    if (error != std::errc{} || end != digits.data() + digits.size()) return {};
    if (std::abs(exponent) > 30) return {};
    return exponent;
}

/// Seconds as decimals, exactly; digits past the ninth behind the point are rounded into it.
std::optional<Time> parse_stamp(std::string_view text) {
    const bool negative = text.starts_with('-');
    if (negative) text.remove_prefix(1);
    const auto exponent = take_exponent(text);
    if (!exponent) return {};
    const auto given_point = std::min(text.find('.'), text.size());
    std::string digits{text};
    if (given_point < digits.size()) digits.erase(given_point, 1);
    if (digits.empty() || !all_digits(digits)) return {};

    const int point = static_cast<int>(given_point) + *exponent;
    if (point < 0) digits.insert(0, static_cast<std::size_t>(-point), '0');
    const auto split = static_cast<std::size_t>(std::max(point, 0));
    digits.resize(std::max(digits.size(), split), '0');
    const auto whole = std::string_view(digits).substr(0, split);
    const auto fraction = std::string_view(digits).substr(split);

    std::int64_t seconds = 0;
    for (const char digit : whole) {
        seconds = seconds * 10 + (digit - '0');
        if (static_cast<double>(seconds) > time_limit_s) return {};
    }
    std::int64_t nanoseconds = 0;
    for (std::size_t i = 0; i < 9; ++i) {
        nanoseconds = nanoseconds * 10 + (i < fraction.size() ? fraction[i] - '0' : 0);
    }
    if (fraction.size() > 9 && fraction[9] >= '5') ++nanoseconds;
    const Time time = std::chrono::seconds{seconds} + Time{nanoseconds};
    return negative ? -time : time;
}

std::optional<double> parse_number(std::string_view text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return {};
    if (!std::isfinite(value)) return {};
    return value;
}

/// Cut at blanks; what follows the eighth column is counted, not kept.
struct Columns {
    std::array<std::string_view, column_names.size()> text;
    std::size_t count = 0;

    explicit Columns(std::string_view line) {
        while (!(line = trimmed(line)).empty()) {
            const auto end = std::min(line.find_first_of(blanks), line.size());
            if (count < text.size()) text[count] = line.substr(0, end);
            ++count;
            line.remove_prefix(end);
        }
    }
};

}  // namespace

std::string_view trimmed(std::string_view text) {
    const auto begin = text.find_first_not_of(blanks);
    if (begin == text.npos) return {};
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

bool says_nothing(std::string_view line) {
    const auto text = trimmed(line);
    return text.empty() || text.front() == '#';
}

std::optional<glm::dquat> normalised_quaternion(double x, double y, double z, double w) {
    const double length = std::sqrt(x * x + y * y + z * z + w * w);
    if (!(length >= 1e-6 && length <= 1e6)) return {};
    return glm::dquat{w / length, x / length, y / length, z / length};
}

std::variant<TimedPose, std::string> parse_tum_line(std::string_view line) {
    const Columns columns{line};
    if (columns.count != column_names.size()) {
        return "a pose has 8 columns (t tx ty tz qx qy qz qw), this line has " +
               std::to_string(columns.count);
    }
    const auto time = parse_stamp(columns.text[0]);
    if (!time) {
        return "t must be seconds as decimals below 9e9, not " + quote(columns.text[0]);
    }
    std::array<double, column_names.size()> value{};
    for (std::size_t i = 1; i < value.size(); ++i) {
        const auto number = parse_number(columns.text[i]);
        if (!number) {
            return std::string{column_names[i]} + " must be a finite number, not " +
                   quote(columns.text[i]);
        }
        value[i] = *number;
    }
    const glm::dvec3 xyz_m{value[1], value[2], value[3]};
    if (!plausible_position(xyz_m)) return "tx ty tz must lie within 1e7 m of the origin";
    const auto rotation = normalised_quaternion(value[4], value[5], value[6], value[7]);
    if (!rotation) return "qx qy qz qw must be a quaternion of length 1";
    return TimedPose{*time, {xyz_m, *rotation}};
}

}  // namespace scipd::sim
