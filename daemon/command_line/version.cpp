// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/command_line/version.h"

namespace scipd::daemon {

std::string version_of(const std::string& program) {
    return program + " " SCIPD_VERSION;
}

}  // namespace scipd::daemon
