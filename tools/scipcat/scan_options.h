// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What all commands of scipcat take: where the scanner is, and for most which part of a scan is
// wanted.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "protocol/client/device_info.h"
#include "protocol/client/scan_request.h"
#include "tools/scipcat/scanner.h"

namespace scipd::tools {

struct ConnectionOptions {
    std::string target;
    int baud = 115200;
    double timeout_s = 1.0;

    void add_to(CLI::App& command);
    [[nodiscard]] Scanner open() const;
};

struct ScanOptions {
    std::optional<int> start;
    std::optional<int> end;
    int cluster = 1;
    bool intensity = false;
    bool echoes = false;

    void add_to(CLI::App& command);
    /// Steps that were not given are the first and the last that the scanner measures.
    [[nodiscard]] protocol::client::ScanRequest request(
        const protocol::client::Parameters& parameters) const;
};

/// Refuses file names with none of the endings.
[[nodiscard]] CLI::Validator ends_in(const std::string& first, const std::string& second);

}  // namespace scipd::tools
