// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The paper's Tables 3 and 4 on this machine: the cost of one scan at each resolution, and that of
// reading a picture back.
#pragma once

#include <array>
#include <iosfwd>
#include <optional>
#include <vector>

#include "sim/world/scene.h"
#include "tools/scipbench/contest.h"
#include "tools/scipbench/paper.h"
#include "tools/scipbench/spread.h"

namespace scipd::tools {

struct Table3Row {
    Resolution resolution;
    std::array<std::optional<Spread>, method_count> all_ms;  ///< nothing: not measured

    [[nodiscard]] const std::optional<Spread>& ms(Method method) const {
        return all_ms[static_cast<std::size_t>(method)];
    }
};

/// Each repetition takes another free pose of the scene, at this height, and scans by each method
/// in turn. On a machine that cannot draw it measures only the methods by rays.
std::vector<Table3Row> measure_table3(const sim::SharedScene& scene, int repetitions,
                                      double height_m, bool draws);

/// A table for people, with the fewest rays for which the depth buffer is the faster. "-" stands
/// for what was not measured; in the CSV such cells are empty.
void print_table3(const std::vector<Table3Row>& rows, std::ostream& out);
void write_table3_csv(const std::vector<Table3Row>& rows, std::ostream& out);

struct Table4Row {
    Resolution resolution;
    Spread depth_ms;
    Spread triangles_ms;  ///< the paper's frame buffer
};

std::vector<Table4Row> measure_table4(const sim::SharedScene& scene, int repetitions,
                                      double height_m);

void print_table4(const std::vector<Table4Row>& rows, std::ostream& out);
void write_table4_csv(const std::vector<Table4Row>& rows, std::ostream& out);

}  // namespace scipd::tools
