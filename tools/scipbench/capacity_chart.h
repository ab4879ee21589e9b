// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/scipbench/capacity_run.h"
#include "tools/scipbench/capacity_stages.h"

namespace scipd::tools {

/// Draws what scipd and its reader use of all cores, over the number of scanners, and marks the
/// numbers that lose scans. Writes a PNG or an SVG, by the file's ending. Throws std::runtime_error
/// if it cannot write the file.
void draw_capacity(const std::vector<CapacityRun>& runs, const StageCosts& costs,
                   const std::string& title, const std::string& machine,
                   const std::filesystem::path& file);

}  // namespace scipd::tools
