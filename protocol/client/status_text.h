// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Describes statuses and damages in words, for people. No thread rule.
#pragma once

#include <string>

#include "protocol/client/message.h"

namespace scipd::protocol::client {

/// "status 05: the last step lies before the first". What a number means depends on the command.
[[nodiscard]] std::string describe_status(const Message& message);

/// "line 3 does not match its checksum"
[[nodiscard]] std::string describe(const Damage& damage);

}  // namespace scipd::protocol::client
