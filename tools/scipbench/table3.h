// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The paper's Table 3 on this machine: what one scan costs at each resolution.
#pragma once

#include <array>
#include <iosfwd>
#include <optional>
#include <vector>

#include "sim/world/scene.h"
#include "tools/scipbench/contest.h"
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

}  // namespace scipd::tools
