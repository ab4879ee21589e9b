// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which column of a table says what of a pose, and the pose of a row. A CSV's header names them;
// EuRoC's are always the same. Any thread; nothing shared.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/expected.h"
#include "sim/loaders/poses/trajectory.h"

namespace scipd::sim {

/// The cells of a row, without the blanks and quotes around them. A blank delimiter stands for any
/// number of blanks.
std::vector<std::string_view> cells_of(std::string_view row, char delimiter);

struct Column {
    std::size_t index = 0;
    std::string name;  ///< as faults call it
};

/// Where in a row the parts of a pose are. Either `quaternion` or `yaw` is set.
struct PoseColumns {
    Column time;
    std::optional<int> time_power;  ///< the unit is 10^power s; nothing: the first stamp tells
    bool whole_stamps = false;      ///< a point in a stamp is a fault
    std::array<Column, 2> xy;
    std::optional<Column> z;                          ///< else 0
    std::optional<std::array<Column, 4>> quaternion;  ///< x, y, z, w
    std::optional<Column> roll;                       ///< else 0, as is pitch
    std::optional<Column> pitch;
    std::optional<Column> yaw;
    double radians_per_unit = 1.0;  ///< of roll, pitch and yaw
    std::size_t least_count = 0;    ///< of cells in a row

    [[nodiscard]] bool same_places(const PoseColumns& other) const;

    /// The pose of a row, or a sentence that names the column that is wrong.
    [[nodiscard]] Expected<TimedPose> pose_of(const std::vector<std::string_view>& cells) const;
};

/// The columns of EuRoC's ground truth.
PoseColumns euroc_columns();

/// Finds the columns by the names in a CSV's header. Columns with other names go to `not_read`.
Expected<PoseColumns> named_columns(const std::vector<std::string_view>& header,
                                    std::vector<std::string>& not_read);

}  // namespace scipd::sim
