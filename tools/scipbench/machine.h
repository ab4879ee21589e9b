// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string>

namespace scipd::tools {

/// The processor, the libraries and the renderer, in one line.
std::string describe_machine();

/// Why this machine cannot draw depth buffers; empty if it can.
std::string why_nothing_is_drawn();

}  // namespace scipd::tools
