// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Has scanners stream all at once, real or emulated, and reads and checks every byte. One thread.
#pragma once

#include <chrono>
#include <iosfwd>
#include <string>
#include <vector>

#include "tools/scipbench/stream_check.h"
#include "tools/target.h"

namespace scipd::tools {

struct StreamReport {
    std::string target;
    std::string model;
    StreamFindings findings;
    std::vector<double> delays_ms;  ///< see StreamCheck
    std::string ended;              ///< why the stream ended too early; empty: it did not
    [[nodiscard]] bool sound() const { return findings.sound() && ended.empty(); }
};

struct LoadReport {
    double seconds = 0.0;
    std::vector<StreamReport> streams;
    [[nodiscard]] std::size_t unsound() const;
};

/// All steps of all scans, for so long or until the user ends it. Throws protocol::client::Error
/// where a scanner cannot be reached or is none.
LoadReport load_scanners(const std::vector<std::string>& targets, std::chrono::seconds duration);

void print_load(const LoadReport& report, std::ostream& out);
void write_load_json(const LoadReport& report, std::ostream& out);

}  // namespace scipd::tools
