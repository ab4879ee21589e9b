// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The pixels of a camera that looks along +x of S: a flat grid behind a pinhole, so that they are
// even in tangents, not in angles. A value; any thread.
//
//         column 0 ..           y = +tan(width / 2)        row 0
//        +----+----+----+----+
//        |    |    |    |    |  row 0, z up                  x = 1 from the pinhole
//        +----+----+----+----+
//        |    |    |    |    |
//        +----+----+----+----+
#pragma once

#include <vector>

#include <glm/vec3.hpp>

namespace scipd::sim {

struct PinholeGrid {
    int columns = 0;
    int rows = 0;
    /// From edge to edge of the outermost pixels, each below pi.
    double width_rad = 0.0;
    double height_rad = 0.0;

    bool operator==(const PinholeGrid&) const = default;

    /// Through the middle of each pixel, in S: row by row, the first row on top, each from the
    /// left. Unit vectors.
    [[nodiscard]] std::vector<glm::vec3> directions() const;
};

}  // namespace scipd::sim
