// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/scan_writer.h"

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace scipd::tools {

ScanWriter::ScanWriter(const std::filesystem::path& file, RecordedScanner scanner)
    : path_(file), scanner_(std::move(scanner)) {
    format_ = file.extension() == ".csv" ? csv_format() : json_lines_format();
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
