// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A recording that grows by one line a scan. Each line leaves in one piece as soon as it is known,
// so that a file that ends early ends after a whole scan. One thread.
#pragma once

#include <chrono>
#include <filesystem>
#include <fstream>
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

class ScanWriter {
  public:
    /// .csv or .jsonl; a file that is there is replaced. Throws std::runtime_error.
    ScanWriter(const std::filesystem::path& file, RecordedScanner scanner);

    /// Throws std::runtime_error where the disk is full.
    void write(const protocol::client::ScanMessage& scan, HostTime received);

  private:
    void write_line(const std::string& text);

    std::filesystem::path path_;
    RecordedScanner scanner_;
    std::unique_ptr<ScanFormat> format_;
    std::ofstream file_;
};

}  // namespace scipd::tools
