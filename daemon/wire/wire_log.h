// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Tells the log, at `debug`, each request that a scanner hears and each reply with its status and
// what it means; at `trace` scans, too. Of more than a few hundred in a second some are left out.
// Lives on the shard of the scanner.
#pragma once

#include <string>

#include "daemon/wire/wire_entry.h"

namespace scipd::daemon {

/// Null where the log does not tell that much. `scanner` is what the log calls it.
[[nodiscard]] TakeEntry wire_log(const std::string& scanner);

/// "tcp hears BM: switches the laser on", "tcp answers BM with 02: the laser is on already"
[[nodiscard]] std::string line_of(const WireEntry& entry);

}  // namespace scipd::daemon
