// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The paper's Table 3 on this machine: what one scan costs at each resolution.
//
//   R      rays, through the backend that does so; which object a ray hits comes for free
//   RwM    the same, and the material of every ray looked up
//   ZB     one pass of the depth buffer, a pixel for a ray, depth read back and made ranges
//   ZBwM   the same, and the triangle numbers read back and made materials
//   exact  the depth backend as scanners use it: all of ZBwM, and edges decided exactly
#pragma once

#include <array>
#include <iosfwd>
#include <vector>

#include "sim/world/scene.h"
#include "tools/scipbench/resolution.h"
#include "tools/scipbench/spread.h"

namespace scipd::tools {

inline constexpr std::array methods{"R", "RwM", "ZB", "ZBwM", "exact"};

struct Table3Row {
    Resolution resolution;
    std::array<Spread, methods.size()> ms;  ///< by method
};

/// Each repetition is at another of the scene's free poses and does all methods in turn.
std::vector<Table3Row> measure_table3(const sim::SharedScene& scene, int repetitions);

/// For a person, with the fewest rays for which the depth buffer is the faster.
void print_table3(const std::vector<Table3Row>& rows, std::ostream& out);
void write_table3_csv(const std::vector<Table3Row>& rows, std::ostream& out);

}  // namespace scipd::tools
