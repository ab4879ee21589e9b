// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/scipbench/compare.h"
#include "tools/scipbench/table3.h"

namespace scipd::tools {

/// Draws time over the number of rays, both in powers of ten, beside the paper's three computers.
/// Writes a PNG or an SVG, by the file's ending. Throws std::runtime_error if it cannot write the
/// file.
void draw_table3(const std::vector<Table3Row>& rows, const std::string& machine,
                 const std::filesystem::path& file);

/// Draws what the rays hit in the scene, from above, and marks where the depth backend differs by
/// more than a millimetre.
void draw_differences(const ComparedScans& scans, const std::string& title,
                      const std::filesystem::path& file);

}  // namespace scipd::tools
