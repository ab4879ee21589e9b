// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string>

namespace scipd::daemon {

/// "scipd 0.1.0", for the program of this name: all are of one version.
std::string version_of(const std::string& program);

}  // namespace scipd::daemon
