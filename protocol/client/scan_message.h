// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The distances of one scan, taken out of its message. A value; no thread rule.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "protocol/client/message.h"
#include "protocol/client/scan_request.h"

namespace scipd::protocol::client {

struct Echo {
    std::uint32_t distance_mm = 0;
    std::uint32_t intensity = 0;  ///< 0 where it was not asked for

    bool operator==(const Echo&) const = default;
};

struct ScanMessage {
    ScanRequest request;  ///< as the echo has it: `scans` is how many are still to come
    std::string status;   ///< 00 a single scan, 99 one of a stream
    // The device's clock at step 0: one of the two.
    std::uint32_t stamp_ms = 0;  ///< 24 bits
    std::uint64_t stamp_us = 0;  ///< %MD and %ME
    // The wires beside the link, where they were asked for.
    std::uint32_t inputs = 0;
    std::uint32_t outputs = 0;
    // One element for each group of `cluster` steps.
    // distances_mm holds the first echo of a group, or a model's code. Where the request's
    // `contents` are not distances, it holds all values as they come.
    std::vector<std::uint32_t> distances_mm;
    std::vector<std::uint32_t> intensities;         ///< of the first echo; empty: not asked for
    std::vector<std::vector<Echo>> further_echoes;  ///< near to far; empty: not asked for
};

/// The scan, or a sentence that says why the message is none: damaged, refused, of another kind, or
/// with more or fewer values than its echo announces.
[[nodiscard]] std::variant<ScanMessage, std::string> parse_scan(const Message& message);

}  // namespace scipd::protocol::client
