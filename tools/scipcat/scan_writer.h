// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A recording that grows by one line for each scan. It writes each line at once and in one piece,
// so that a file always ends after a whole scan. One thread.
#pragma once

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "protocol/client/scan_message.h"
#include "tools/scipcat/scan_format.h"

namespace scipd::tools {

class ScanWriter {
  public:
    /// The file is a .csv or a .jsonl; an old file is replaced. Throws std::runtime_error.
    ScanWriter(const std::filesystem::path& file, RecordedScanner scanner);

    /// Throws std::runtime_error if the disk is full.
    void write(const protocol::client::ScanMessage& scan, HostTime received);

  private:
    void write_line(const std::string& text);

    std::filesystem::path path_;
    RecordedScanner scanner_;
    std::unique_ptr<ScanFormat> format_;
    std::ofstream file_;
};

}  // namespace scipd::tools
