// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/text/text_number.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace scipd::sim {
namespace {

constexpr std::string_view blanks = " \t\r\n\v\f";

bool all_digits(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Removes the power of ten at the end of a stamp, as evo writes it (1.70e+09), and returns it; 0
/// if there is none. Nothing if it is no number, or is too large for any sensible stamp.
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

}  // namespace

std::string_view trimmed(std::string_view text) {
    const auto begin = text.find_first_not_of(blanks);
    if (begin == text.npos) return {};
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::optional<Time> parse_stamp(std::string_view text, int power) {
    const bool negative = text.starts_with('-');
    if (negative) text.remove_prefix(1);
    const auto exponent = take_exponent(text);
    if (!exponent) return {};
    const auto given_point = std::min(text.find('.'), text.size());
    std::string digits{text};
    if (given_point < digits.size()) digits.erase(given_point, 1);
    if (digits.empty() || !all_digits(digits)) return {};

    const int point = static_cast<int>(given_point) + *exponent + power;
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
    if (end != text.data() + text.size() || error == std::errc::invalid_argument) return {};
    // Too close to 0 or too large for a double: from_chars() does not say which.
    if (error != std::errc{}) value = std::strtod(std::string{text}.c_str(), nullptr);
    if (!std::isfinite(value)) return {};
    return value;
}

std::optional<std::vector<double>> parse_numbers(std::string_view text, std::size_t count) {
    std::vector<double> numbers;
    for (auto begin = text.find_first_not_of(blanks); begin != text.npos;
         begin = text.find_first_not_of(blanks)) {
        text.remove_prefix(begin);
        std::string_view word = text.substr(0, text.find_first_of(blanks));
        text.remove_prefix(word.size());
        if (word.starts_with('+')) word.remove_prefix(1);
        const auto number = parse_number(word);
        if (!number || numbers.size() == count) return std::nullopt;
        numbers.push_back(*number);
    }
    return numbers.size() == count ? std::optional(numbers) : std::nullopt;
}

}  // namespace scipd::sim
