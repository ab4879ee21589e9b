// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How a recording is written: CSV or JSON lines, which have a source each. Not the file that it is
// written to: that is in scan_writer.h. One thread.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "protocol/client/device_info.h"
#include "protocol/client/scan_message.h"

namespace scipd::tools {

/// What a recording must say so that its numbers can be read without the scanner.
struct RecordedScanner {
    std::string model;
    std::string serial;
    std::string firmware;
    protocol::client::Parameters parameters;
    protocol::client::ScanRequest request;
};

using HostTime = std::chrono::system_clock::time_point;

/// Seconds since 1970 to the microsecond.
[[nodiscard]] std::string unix_seconds(HostTime time);

class ScanFormat {
  public:
    virtual ~ScanFormat() = default;

    /// Whole lines before the first scan; may be empty.
    [[nodiscard]] virtual std::string head(const RecordedScanner& scanner) const = 0;
    /// One whole line.
    [[nodiscard]] virtual std::string line(const RecordedScanner& scanner,
                                           const protocol::client::ScanMessage& scan,
                                           HostTime received) const = 0;
};

/// Comments that explain the columns, then numbers only: numpy.loadtxt and gnuplot read it as it is
/// (with echoes, a cell is empty where there is no echo).
[[nodiscard]] std::unique_ptr<ScanFormat> csv_format();

/// One object a scan, each complete in itself.
[[nodiscard]] std::unique_ptr<ScanFormat> json_lines_format();

}  // namespace scipd::tools
