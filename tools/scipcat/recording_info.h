// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string>

namespace scipd::tools {

/// Prints what the recording holds, for people or as JSON. Throws WrongInput if it cannot be read.
void show_recording(const std::string& target, bool json);

}  // namespace scipd::tools
