// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The distances of one scan, read from its message. A value; no thread rule.
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
    std::uint32_t intensity = 0;  ///< 0 if it was not requested

    bool operator==(const Echo&) const = default;
};

struct ScanMessage {
    ScanRequest request;  ///< as the echo has it: `scans` is how many are still to come
    std::string status;   ///< 00: a single scan, 99: a scan of a stream
    // The device's clock at step 0, in one of two units.
    std::uint32_t stamp_ms = 0;  ///< 24 bits
    std::uint64_t stamp_us = 0;  ///< %MD and %ME
    // The scanner's digital inputs and outputs, if they were requested.
    std::uint32_t inputs = 0;
    std::uint32_t outputs = 0;
    // One element for each group of `cluster` steps.
    // distances_mm holds the first echo of a group, or a code of the model. If the request's
    // `contents` are not distances, it holds all values in the order in which they came.
    std::vector<std::uint32_t> distances_mm;
    std::vector<std::uint32_t> intensities;         ///< of the first echo; empty: not requested
    std::vector<std::vector<Echo>> further_echoes;  ///< near to far; empty: not requested
};

/// The scan, or a sentence that says why there is none: the message is damaged, refused or of
/// another kind, or has more or fewer values than its echo announces.
[[nodiscard]] std::variant<ScanMessage, std::string> parse_scan(const Message& message);

}  // namespace scipd::protocol::client
