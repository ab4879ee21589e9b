// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/scan_writer.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "tools/scipcat/csv_writer.h"
#include "tools/scipcat/json_lines_writer.h"

namespace scipd::tools {

std::string unix_seconds(HostTime time) {
    const auto since_1970 = time.time_since_epoch();
    const auto us = std::chrono::duration_cast<std::chrono::microseconds>(since_1970).count();
    char text[40];
    std::snprintf(text, sizeof text, "%lld.%06lld", static_cast<long long>(us / 1000000),
                  static_cast<long long>(us % 1000000));
    return text;
}

ScanWriter::ScanWriter(const std::filesystem::path& file, RecordedScanner scanner)
    : path_(file), scanner_(std::move(scanner)) {
    if (file.extension() == ".csv") {
        format_ = std::make_unique<CsvFormat>();
    } else {
        format_ = std::make_unique<JsonLinesFormat>();
    }
    file_.open(file, std::ios::binary | std::ios::trunc);
    write_line(format_->head(scanner_));
}

void ScanWriter::write(const protocol::client::ScanMessage& scan, HostTime received) {
    write_line(format_->line(scanner_, scan, received));
}

void ScanWriter::write_line(const std::string& text) {
    file_.write(text.data(), static_cast<std::streamsize>(text.size())).flush();
    if (!file_)
        throw std::runtime_error("cannot write " + path_.string() + ": " + std::strerror(errno));
}

}  // namespace scipd::tools
