// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The distances of one scan in SCIP 1.1, which has neither sums nor stamps. A value; no thread
// rule.
#pragma once

#include <optional>

#include "protocol/client/message.h"
#include "protocol/client/scan_message.h"

namespace scipd::protocol::client {

/// The answer to G: start 3, end 3, cluster 2. Nothing if the message is another one, or has more
/// or fewer values than its echo announces. The stamp is 0.
[[nodiscard]] std::optional<ScanMessage> parse_scip1_scan(const Message& message);

}  // namespace scipd::protocol::client
