// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/poses/tum_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include <glm/geometric.hpp>

#include "sim/text/quote.h"
#include "sim/text/text_number.h"
#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

constexpr std::array tum_columns{"t", "tx", "ty", "tz", "qx", "qy", "qz", "qw"};
constexpr std::string_view blanks = " \t\r\n\v\f";

/// The columns of a line, cut at blanks. Those after the eighth are counted, but not kept.
struct Columns {
    std::array<std::string_view, tum_columns.size()> text;
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

std::optional<glm::dquat> normalised_quaternion(double x, double y, double z, double w) {
    const double length = std::sqrt(x * x + y * y + z * z + w * w);
    if (!(length >= 1e-6 && length <= 1e6)) return {};
    return glm::dquat{w / length, x / length, y / length, z / length};
}

Expected<glm::dquat> quaternion_in_file(const glm::dvec4& xyzw, const std::string& columns) {
    constexpr double tolerance = 0.02;
    const double length = glm::length(xyzw);
    if (std::abs(length - 1.0) <= tolerance)
        return glm::dquat{xyzw.w, xyzw.x, xyzw.y, xyzw.z} / length;
    std::array<char, 32> figure{};
    std::snprintf(figure.data(), figure.size(), "%.4g", length);
    return refuse(columns + " must be a quaternion of length 1, not " + figure.data() +
                  "; divide each by that, or see whether the columns are these");
}

Expected<TimedPose> parse_tum_line(std::string_view line) {
    const Columns columns{line};
    if (columns.count != tum_columns.size()) {
        return refuse("a pose has 8 columns (t tx ty tz qx qy qz qw), this line has " +
                      std::to_string(columns.count));
    }
    const auto time = parse_stamp(columns.text[0]);
    if (!time) {
        return refuse("t",
                      "t must be seconds as decimals below 9e9, not " + quote(columns.text[0]));
    }
    std::array<double, tum_columns.size()> value{};
    for (std::size_t i = 1; i < value.size(); ++i) {
        const auto number = parse_number(columns.text[i]);
        if (!number) {
            return refuse(std::string{tum_columns[i]} + " must be a finite number, not " +
                          quote(columns.text[i]));
        }
        value[i] = *number;
    }
    const glm::dvec3 xyz_m{value[1], value[2], value[3]};
    if (!plausible_position(xyz_m)) return refuse("tx ty tz must lie within 1e7 m of the origin");
    const auto rotation =
        quaternion_in_file({value[4], value[5], value[6], value[7]}, "qx qy qz qw");
    if (!rotation) return tl::unexpected(rotation.error());
    return TimedPose{*time, {xyz_m, *rotation}};
}

}  // namespace scipd::sim
