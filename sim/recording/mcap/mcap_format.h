// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The records of an MCAP file, as its public specification has them (https://mcap.dev/spec). A
// record is an opcode, a length of 64 bits, and so many bytes:
//
//   magic Header  Schema* Channel* Metadata*  (Chunk MessageIndex*)*  DataEnd
//   summary: Schema* Channel* Statistics ChunkIndex* MetadataIndex* SummaryOffset*  Footer magic
//
// A chunk is a packed block of Schema, Channel and Message records. Values; no thread rule.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "sim/expected.h"
#include "sim/recording/values/scanner_identity.h"

namespace scipd::sim::mcap {

inline constexpr std::string_view magic{"\x89MCAP0\r\n", 8};
/// Opcode and length.
inline constexpr std::size_t record_head = 9;

enum class Opcode : std::uint8_t {
    header = 0x01,
    footer = 0x02,
    schema = 0x03,
    channel = 0x04,
    message = 0x05,
    chunk = 0x06,
    message_index = 0x07,
    chunk_index = 0x08,
    attachment = 0x09,
    attachment_index = 0x0A,
    statistics = 0x0B,
    metadata = 0x0C,
    metadata_index = 0x0D,
    summary_offset = 0x0E,
    data_end = 0x0F,
};

struct Schema {
    std::uint16_t id = 0;
    std::string name;
    std::string encoding;
    std::string data;
};

struct Channel {
    std::uint16_t id = 0;
    std::uint16_t schema = 0;  ///< 0: none
    std::string topic;
    std::string encoding;
    Entries metadata;
};

struct Message {
    std::uint16_t channel = 0;
    std::uint32_t sequence = 0;
    std::uint64_t log_ns = 0;      ///< when it was recorded, since 1970
    std::uint64_t publish_ns = 0;  ///< when it was sent
    std::string_view data;         ///< of the bytes that were parsed
};

struct Chunk {
    std::uint64_t first_ns = 0;
    std::uint64_t last_ns = 0;
    std::uint64_t size = 0;  ///< of the records, when unpacked
    std::uint32_t crc = 0;   ///< of the unpacked records; 0: not told
    std::string_view compression;
    std::string_view records;
};

struct Metadata {
    std::string name;
    Entries entries;
};

/// Appends numbers and texts to bytes, little end first.
class ByteWriter {
  public:
    template <std::unsigned_integral Number>
    ByteWriter& number(Number value) {
        for (std::size_t i = 0; i < sizeof(Number); ++i)
            bytes_.push_back(static_cast<char>(static_cast<std::uint64_t>(value) >> 8 * i & 0xFF));
        return *this;
    }
    ByteWriter& raw(std::string_view bytes) {
        bytes_.append(bytes);
        return *this;
    }
    /// A length of 32 bits and the bytes.
    ByteWriter& text(std::string_view text) {
        return number(static_cast<std::uint32_t>(text.size())).raw(text);
    }

    [[nodiscard]] const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
};

// The content of a record, without its head. Each refuses one that ends too early.
[[nodiscard]] Expected<Schema> parse_schema(std::string_view content);
[[nodiscard]] Expected<Channel> parse_channel(std::string_view content);
[[nodiscard]] Expected<Message> parse_message(std::string_view content);
[[nodiscard]] Expected<Chunk> parse_chunk(std::string_view content);
[[nodiscard]] Expected<Metadata> parse_metadata(std::string_view content);

[[nodiscard]] std::string record(Opcode opcode, std::string_view content);
[[nodiscard]] std::string schema_record(const Schema& schema);
[[nodiscard]] std::string channel_record(const Channel& channel);
[[nodiscard]] std::string message_record(const Message& message);
[[nodiscard]] std::string chunk_record(const Chunk& chunk);
[[nodiscard]] std::string metadata_record(const Metadata& metadata);

/// The sum that MCAP has, which is that of Ethernet and zip.
[[nodiscard]] std::uint32_t crc32(std::string_view bytes);

}  // namespace scipd::sim::mcap
