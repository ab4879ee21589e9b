// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The records of an MCAP file, one after the other, without its index, so that one whose writer was
// killed is read as well. The index serves where a record is damaged: it says where the next chunk
// begins. Of one owner; any thread.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "sim/recording/file/input_file.h"
#include "sim/recording/mcap/mcap_format.h"

namespace scipd::sim::mcap {

/// A record of the file, which is not yet read.
struct RecordHead {
    Opcode opcode{};
    std::uint64_t byte = 0;   ///< offset in the file
    std::uint64_t begin = 0;  ///< offset of its content
    std::uint64_t length = 0;
};

class RecordReader {
  public:
    using Lose = std::function<void(const tl::unexpected<Fault>&)>;
    /// `lose` gets what is damaged.
    RecordReader(InputFile& file, Lose lose) : file_(file), lose_(std::move(lose)) {}

    /// The next record, also of the summary; nullopt at the end of the file.
    [[nodiscard]] Expected<std::optional<RecordHead>> next();

    /// True once the records of the summary come.
    [[nodiscard]] bool in_summary() const { return in_summary_; }
    /// What is missing at the end of the file, for the user; empty: it is whole.
    [[nodiscard]] const std::string& lost() const { return lost_; }

  private:
    [[nodiscard]] std::optional<std::uint64_t> chunk_behind(std::uint64_t byte);

    InputFile& file_;
    Lose lose_;
    std::uint64_t next_byte_ = magic.size();
    bool in_summary_ = false;
    std::string lost_;
};

/// The records of a chunk, once its checksum is right.
[[nodiscard]] Expected<std::string> unpack_chunk(std::string_view content);

}  // namespace scipd::sim::mcap
