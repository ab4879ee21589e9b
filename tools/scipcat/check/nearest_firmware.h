// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which firmware of those that scipd knows a scanner resembles most. One thread.
#pragma once

#include <cstddef>
#include <string>

#include "tools/scipcat/check/subject.h"

namespace scipd::tools::checks {

struct NearestFirmware {
    std::string model;  ///< as `scipd --list-models` prints it
    std::size_t alike = 0;
    std::size_t of = 0;
};

/// Asks the scanner some hundred questions. Throws protocol::client::Error.
[[nodiscard]] NearestFirmware nearest_firmware(Subject& subject);

}  // namespace scipd::tools::checks
