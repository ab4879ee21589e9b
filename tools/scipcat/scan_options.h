// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The options that scipcat's commands share: where the scanner is, and for most commands which part
// of a scan to ask for.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "protocol/client/device_info.h"
#include "protocol/client/scan_request.h"
#include "tools/scipcat/connected_scanner.h"

namespace scipd::tools {

/// What a command can look at.
enum class Targets { scanners, scanners_and_recordings };

struct ConnectionOptions {
    std::string target;
    int baud = 115200;
    double timeout_s = 1.0;

    void add_to(CLI::App& command, Targets targets = Targets::scanners,
                const std::string& name = "TARGET");
    /// How long to wait for an answer.
    [[nodiscard]] std::chrono::milliseconds patience() const;
    [[nodiscard]] ConnectedScanner open(TappedTransport::Listener listener = {}) const;
};

/// A target by itself, as each of two has it.
void add_target(CLI::App& command, const std::string& name, std::string& target, Targets targets);

struct ScanOptions {
    std::optional<int> start;
    std::optional<int> end;
    int cluster = 1;
    bool intensity = false;
    bool echoes = false;

    void add_to(CLI::App& command);
    /// If a first or last step was not given, it is the first or last that the scanner measures.
    [[nodiscard]] protocol::client::ScanRequest request(
        const protocol::client::Parameters& parameters) const;
    /// Throws WrongInput where a part of the scan was asked for: a recording has what it has.
    void take_all_of_recording() const;
};

/// Refuses file names with none of these endings.
[[nodiscard]] CLI::Validator ends_in(const std::vector<std::string>& endings);

}  // namespace scipd::tools
