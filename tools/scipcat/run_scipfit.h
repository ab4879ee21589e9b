// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Has scipfit fit recordings. It is a program of its own, since it alone links a solver of least
// squares: scipcat starts as fast without. One thread.
#pragma once

#include <string>
#include <vector>

namespace scipd::tools {

/// Throws WrongInput where scipfit does not lie beside this program.
void require_scipfit();

/// What it writes on standard output. On a terminal says meanwhile that it fits. Throws WrongInput
/// and std::runtime_error with what it says on standard error.
[[nodiscard]] std::string run_scipfit(const std::vector<std::string>& words);

}  // namespace scipd::tools
