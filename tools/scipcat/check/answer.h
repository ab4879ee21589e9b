// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One whole message of a scanner: its bytes, its parts, and when it came. A value; no thread rule.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "protocol/client/message.h"
#include "protocol/client/scan_message.h"
#include "tools/scipcat/check/conversation.h"
#include "tools/scipcat/check/finding.h"

namespace scipd::tools::checks {

struct Answer {
    std::string raw;  ///< with the empty line at its end
    protocol::client::Message message;
    Clock::time_point asked_at{};
    Clock::time_point begun_at{};     ///< its first byte came
    Clock::time_point came_at{};      ///< all of it has come
    std::vector<std::string> before;  ///< messages that came between the request and this

    [[nodiscard]] const std::string& status() const { return message.status; }
    /// The lines without their line ends: echo, status, then what follows, each with its sum.
    [[nodiscard]] std::vector<std::string> lines() const;
    [[nodiscard]] double took_ms() const;
};

/// True if a command without parameters is unknown: 0D, 0E, 0F, or empty for no answer. A request
/// as short as that cannot be too long.
[[nodiscard]] bool is_unknown(std::string_view status);

[[nodiscard]] Answer read_answer(std::string raw);

/// Whether the reply is sound and has this status. Without data it must be the very bytes of echo,
/// status, sum and empty line.
Finding has_status(const Answer& answer, std::string_view status);

/// Whether it is a sound scan with just this echo: no damage, and as many values as announced.
Finding is_scan(const Answer& answer, std::string_view echo);

/// Passes a sound scan with its own echo and the status of its command: 99 in a stream, else 00.
Finding is_scan(const Answer& answer);

/// The scan of a message that must be one. Throws protocol::client::Error.
[[nodiscard]] protocol::client::ScanMessage scan_of(const Answer& answer);

}  // namespace scipd::tools::checks
