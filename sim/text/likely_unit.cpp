// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/text/likely_unit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace scipd::sim {
namespace {

constexpr double full_turn_rad = 2.0 * std::numbers::pi;
constexpr double rad_per_degree = std::numbers::pi / 180.0;
constexpr double m_per_mm = 1e-3;
constexpr double least_mm = 50.0;

/// Whether people would write it so.
bool is_round(double number) {
    constexpr double tolerance = 1e-6;
    const double tenths = 10.0 * number;
    return std::abs(tenths - std::round(tenths)) < tolerance;
}

/// Each times the factor: "0.2, 0, 0.25"
std::string listed(std::span<const double> numbers, double factor) {
    std::string text;
    for (const double number : numbers) {
        std::array<char, 32> digits{};
        std::snprintf(digits.data(), digits.size(), factor == 1.0 ? "%.10g" : "%.5g",
                      number * factor);
        text += (text.empty() ? "" : ", ") + std::string(digits.data());
    }
    return text;
}

std::string guess(std::span<const double> numbers, const char* looks, double factor) {
    return listed(numbers, 1.0) + looks + listed(numbers, factor) + "?";
}

}  // namespace

std::optional<std::string> degrees_for_radians(std::span<const double> angles_rad) {
    const bool beyond = std::ranges::any_of(
        angles_rad, [](double angle_rad) { return std::abs(angle_rad) > full_turn_rad; });
    if (!beyond || !std::ranges::all_of(angles_rad, is_round)) return std::nullopt;
    return guess(angles_rad, " looks like degrees, but angles are radians; did you mean ",
                 rad_per_degree);
}

bool could_be_millimetres(std::span<const double> lengths_m) {
    const auto far = [](double length_m) { return std::abs(length_m) >= least_mm; };
    const auto fits = [](double length_m) {
        return is_round(length_m) && (length_m == 0.0 || std::abs(length_m) >= 1.0);
    };
    return std::ranges::any_of(lengths_m, far) && std::ranges::all_of(lengths_m, fits);
}

std::string millimetres_for_metres(std::span<const double> lengths_m) {
    return guess(lengths_m, " looks like millimetres, but lengths are metres; did you mean ",
                 m_per_mm);
}

}  // namespace scipd::sim
