// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Finds the program scipd: what SCIPD names, then PATH, then the folder of the test program, then
// the build folders beside it. Any thread.
#pragma once

#include <filesystem>

namespace scipd::testing {

/// Throws ScipdNotFound.
[[nodiscard]] std::filesystem::path find_program();

}  // namespace scipd::testing
