// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The paper's Table 4 on this machine: what it costs to read a picture back.
#pragma once

#include <iosfwd>
#include <vector>

#include "sim/world/scene.h"
#include "tools/scipbench/resolution.h"
#include "tools/scipbench/spread.h"

namespace scipd::tools {

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
