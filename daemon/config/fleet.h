// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The key `fleet` of a configuration: which world this daemon shares with others, and by which
// broker. Any thread; nothing shared.
#pragma once

#include <filesystem>

#include "daemon/config/config.h"
#include "daemon/config/section.h"

namespace scipd::daemon {

void read_fleet(const Field& field, const std::filesystem::path& base, Config& config,
                Faults& faults);

}  // namespace scipd::daemon
