// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The format of a recording: CSV or JSON lines, each in a source of its own. scan_writer.h writes
// the file. One thread.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "protocol/client/device_info.h"
#include "protocol/client/scan_message.h"

namespace scipd::tools {

/// What a recording must hold so that its numbers can be read without the scanner.
struct RecordedScanner {
    std::string model;
    std::string serial;
    std::string firmware;
    protocol::client::Parameters parameters;
    protocol::client::ScanRequest request;
};

using HostTime = std::chrono::system_clock::time_point;

/// Seconds since 1970, with microseconds.
[[nodiscard]] std::string unix_seconds(HostTime time);

class ScanFormat {
  public:
    virtual ~ScanFormat() = default;

    /// The whole lines before the first scan; may be empty.
    [[nodiscard]] virtual std::string head(const RecordedScanner& scanner) const = 0;
    /// The scan as one whole line.
    [[nodiscard]] virtual std::string line(const RecordedScanner& scanner,
                                           const protocol::client::ScanMessage& scan,
                                           HostTime received) const = 0;
};

/// Comments that explain the columns, then numbers only, which numpy.loadtxt and gnuplot read
/// without options. With echoes, a cell is empty if the step has no such echo.
[[nodiscard]] std::unique_ptr<ScanFormat> csv_format();

/// One object for each scan, complete in itself.
[[nodiscard]] std::unique_ptr<ScanFormat> json_lines_format();

}  // namespace scipd::tools
