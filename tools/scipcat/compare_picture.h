// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A comparison as a picture: what both see from above, with what differs in colour, and below how
// much each step differs. One thread.
#pragma once

#include <filesystem>

#include "tools/scipcat/compare/comparison.h"

namespace scipd::tools {

/// Throws std::runtime_error if it cannot be written.
void draw_comparison(const std::filesystem::path& file, const comparing::Comparison& comparison);

}  // namespace scipd::tools
