// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string>

namespace scipd::tools {

/// The processor, the libraries and the renderer, in one line.
std::string describe_machine();

/// Why no depth buffer can be drawn on this machine; empty where one can.
std::string why_nothing_is_drawn();

}  // namespace scipd::tools
