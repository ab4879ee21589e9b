// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads an MCAP file record after record, without its index, so that one whose writer was killed is
// read as well. The records of chunks come in place of the chunk, once its sum was checked. Of one
// owner; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "sim/recording/file/byte_reader.h"
#include "sim/recording/file/input_file.h"
#include "sim/recording/mcap/mcap_format.h"

namespace scipd::sim::mcap {

struct Record {
    Opcode opcode{};
    std::uint64_t byte = 0;    ///< where it, or the chunk that it is in, begins in the file
    std::string_view content;  ///< until the next one is read
};

class RecordReader {
  public:
    explicit RecordReader(InputFile file) : file_(std::move(file)) {}

    /// Whether the file is MCAP at all.
    [[nodiscard]] Expected<> check_magic();

    /// The next Schema, Channel, Message, Metadata or Header; nothing at the end of the data.
    [[nodiscard]] Expected<std::optional<Record>> next();

    /// From now on chunks that end before this time are passed over unread.
    void skip_to(std::uint64_t log_ns) { skip_to_ns_ = log_ns; }

    /// What is missing at the end of the file, for the user; empty: it is whole.
    [[nodiscard]] const std::string& lost() const { return lost_; }
    [[nodiscard]] const InputFile& file() const { return file_; }

  private:
    [[nodiscard]] Expected<std::optional<Record>> next_in_file();
    [[nodiscard]] Expected<std::optional<Record>> next_in_chunk();
    [[nodiscard]] Expected<bool> is_early(std::uint64_t chunk);
    [[nodiscard]] Expected<> unpack(std::string_view content);
    [[nodiscard]] std::optional<Record> ends(const std::string& how);

    InputFile file_;
    std::uint64_t next_byte_ = magic.size();
    std::uint64_t skip_to_ns_ = 0;
    std::uint64_t byte_ = 0;  ///< where the record in content_ begins
    std::string content_;
    std::string chunk_;  ///< unpacked
    ByteReader in_chunk_{{}};
    std::string lost_;
};

}  // namespace scipd::sim::mcap
