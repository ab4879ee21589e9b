// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads the rows of a table. Finding its columns by their names is in column_names.cpp.
#include "sim/loaders/poses/pose_columns.h"

#include <algorithm>
#include <cmath>

#include "sim/loaders/poses/pose_line.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"
#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

constexpr double largest_angle_rad = 1e6;

std::string_view bare(std::string_view cell) {
    cell = trimmed(cell);
    const bool quoted = cell.size() > 1 && cell.front() == '"' && cell.back() == '"';
    return quoted ? trimmed(cell.substr(1, cell.size() - 2)) : cell;
}

/// Reads cell after cell, and remembers the first that is wrong.
class RowReader {
  public:
    RowReader(const PoseColumns& columns, const std::vector<std::string_view>& cells)
        : columns_(columns), cells_(cells) {}

    Time time() {
        const std::string_view cell = cells_[columns_.time.index];
        const bool has_point = cell.find_first_of(".eE") != cell.npos;
        const auto time = parse_stamp(cell, columns_.time_power.value_or(0));
        if (columns_.whole_stamps && has_point) {
            note(columns_.time, "must be whole nanoseconds", cell);
        } else if (!time) {
            note(columns_.time, "must be a time in decimals, below 9e9 s", cell);
        }
        return time.value_or(Time{});
    }

    double number(const Column& column) {
        const auto value = parse_number(cells_[column.index]);
        if (!value) note(column, "must be a finite number", cells_[column.index]);
        return value.value_or(0.0);
    }
    double number(const std::optional<Column>& column) { return column ? number(*column) : 0.0; }

    double angle_rad(const std::optional<Column>& column) {
        const double value_rad = number(column) * columns_.radians_per_unit;
        if (std::abs(value_rad) <= largest_angle_rad) return value_rad;
        note(*column, "must lie within 1e6 rad", cells_[column->index]);
        return 0.0;
    }

    glm::dquat rotation() {
        if (!columns_.quaternion) {
            const double roll_rad = angle_rad(columns_.roll);
            const double pitch_rad = angle_rad(columns_.pitch);
            return pose_from_rpy({}, {roll_rad, pitch_rad, angle_rad(columns_.yaw)}).rotation;
        }
        std::array<double, 4> q{};
        std::ranges::transform(*columns_.quaternion, q.begin(),
                               [this](const Column& column) { return number(column); });
        const auto& names = *columns_.quaternion;
        const auto rotation =
            quaternion_in_file({q[0], q[1], q[2], q[3]}, names[0].name + " to " + names[3].name);
        if (!rotation) note(rotation.error().why);
        return rotation.value_or(glm::dquat{1.0, 0.0, 0.0, 0.0});
    }

    void note(const std::string& why) {
        if (!first_fault_) first_fault_ = Fault{{}, why};
    }

    [[nodiscard]] const std::optional<Fault>& first_fault() const { return first_fault_; }

  private:
    void note(const Column& column, const std::string& why, std::string_view cell) {
        note(column.name + ' ' + why + ", not " + quote(cell));
    }

    const PoseColumns& columns_;
    const std::vector<std::string_view>& cells_;
    std::optional<Fault> first_fault_;
};

}  // namespace

std::vector<std::string_view> cells_of(std::string_view row, char delimiter) {
    std::vector<std::string_view> cells;
    row = trimmed(row);
    while (true) {
        const auto found = delimiter == ' ' ? row.find_first_of(" \t") : row.find(delimiter);
        const auto end = std::min(found, row.size());
        cells.push_back(bare(row.substr(0, end)));
        if (end == row.size()) return cells;
        row.remove_prefix(end + 1);
        if (delimiter == ' ') row = trimmed(row);
    }
}

bool PoseColumns::same_places(const PoseColumns& other) const {
    const auto places = [](const PoseColumns& columns) {
        std::vector<std::size_t> all{columns.time.index, columns.xy[0].index, columns.xy[1].index};
        if (columns.z) all.push_back(columns.z->index);
        for (const Column& column : columns.quaternion.value_or(std::array<Column, 4>{}))
            all.push_back(column.index);
        return all;
    };
    return places(*this) == places(other);
}

Expected<TimedPose> PoseColumns::pose_of(const std::vector<std::string_view>& cells) const {
    if (cells.size() < least_count) {
        return refuse("a pose has " + std::to_string(least_count) +
                      " columns or more, this line has " + std::to_string(cells.size()));
    }
    RowReader row{*this, cells};
    TimedPose pose;
    pose.time = row.time();
    pose.pose.translation_m = {row.number(xy[0]), row.number(xy[1]), row.number(z)};
    if (!plausible_position(pose.pose.translation_m)) {
        row.note(xy[0].name + ", " + xy[1].name + (z ? " and " + z->name : std::string()) +
                 " must lie within 1e7 m of the origin");
    }
    pose.pose.rotation = row.rotation();
    if (row.first_fault()) return tl::unexpected(*row.first_fault());
    return pose;
}

PoseColumns euroc_columns() {
    return {.time = {0, "timestamp"},
            .time_power = -9,
            .whole_stamps = true,
            .xy = {{{1, "p_x"}, {2, "p_y"}}},
            .z = Column{3, "p_z"},
            .quaternion = {{{{5, "q_x"}, {6, "q_y"}, {7, "q_z"}, {4, "q_w"}}}},
            .roll = {},
            .pitch = {},
            .yaw = {},
            .least_count = 8};
}

}  // namespace scipd::sim
