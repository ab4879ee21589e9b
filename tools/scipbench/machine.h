// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string>

namespace scipd::tools {

/// The processor, the libraries and what draws, in one line.
std::string describe_machine();

}  // namespace scipd::tools
