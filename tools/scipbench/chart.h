// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/scipbench/compare.h"
#include "tools/scipbench/table3.h"

namespace scipd::tools {

/// Time over rays, both in powers of ten, beside the paper's three computers. PNG or SVG, by the
/// file's ending. Throws std::runtime_error where the file cannot be written.
void draw_table3(const std::vector<Table3Row>& rows, const std::string& machine,
                 const std::filesystem::path& file);

/// The scene as it was hit, seen from above, and where the depth backend differs by more than a
/// millimetre.
void draw_differences(const ComparedScans& scans, const std::string& title,
                      const std::filesystem::path& file);

}  // namespace scipd::tools
