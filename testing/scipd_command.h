// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The command line of a scipd for a test: free ports, and files in a folder of its own. No thread
// rule.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "testing/scipd_options.h"

namespace scipd::testing {

/// With the program. What `args` of the options has as well is left to it. Throws
/// std::invalid_argument.
[[nodiscard]] std::vector<std::string> command_for(const Options& options,
                                                   const std::filesystem::path& program,
                                                   const std::filesystem::path& folder);

}  // namespace scipd::testing
