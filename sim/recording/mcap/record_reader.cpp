// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/mcap/record_reader.h"

#include "sim/recording/compression/compression.h"
#include "sim/recording/file/byte_reader.h"
#include "sim/text/quote.h"

namespace scipd::sim::mcap {

Expected<std::optional<RecordHead>> RecordReader::next() {
    for (;;) {
        const std::uint64_t byte = next_byte_;
        const auto bytes = file_.read(byte, record_head);
        if (!bytes) return tl::unexpected(bytes.error());
        if (bytes->empty()) {
            if (!in_summary_) lost_ = "has no index: its writer was stopped before it ended";
            return std::nullopt;
        }
        ByteReader reader(*bytes);
        RecordHead head{static_cast<Opcode>(reader.number<std::uint8_t>()), byte,
                        byte + record_head, reader.number<std::uint64_t>()};
        // A file system that lost its power may leave zeros.
        if (reader.too_short() || head.opcode == Opcode{} || head.begin > file_.size() ||
            head.length > file_.size() - head.begin) {
            const auto chunk = in_summary_ ? std::nullopt : chunk_behind(byte);
            if (!chunk) {
                if (!in_summary_)
                    lost_ = "ends within the record at byte " + std::to_string(byte) +
                            ", which is lost: its writer was stopped there";
                return std::nullopt;
            }
            lose_(file_.refuse_byte(
                byte, "the record here is damaged, up to byte " + std::to_string(*chunk)));
            next_byte_ = *chunk;
            continue;
        }
        next_byte_ = head.begin + head.length;
        if (head.opcode == Opcode::footer) return std::nullopt;
        if (head.opcode != Opcode::data_end) return head;
        in_summary_ = true;
    }
}

/// By the index: the next chunk, or the index itself.
std::optional<std::uint64_t> RecordReader::chunk_behind(std::uint64_t byte) {
    constexpr std::uint64_t footer = 20;  // bytes of its content
    if (file_.size() < footer + magic.size()) return std::nullopt;
    const auto end = file_.read(file_.size() - footer - magic.size(), footer + magic.size());
    if (!end || !end->ends_with(magic)) return std::nullopt;
    const auto index = ByteReader(*end).number<std::uint64_t>();
    if (index <= byte) return std::nullopt;
    std::uint64_t nearest = index;
    for (std::uint64_t at = index; at < file_.size();) {
        const auto bytes = file_.read(at, record_head + 3 * sizeof(std::uint64_t));
        if (!bytes) break;
        ByteReader reader(*bytes);
        const auto opcode = static_cast<Opcode>(reader.number<std::uint8_t>());
        const auto length = reader.number<std::uint64_t>();
        reader.skip(2 * sizeof(std::uint64_t));  // the times of its first and last message
        const auto chunk = reader.number<std::uint64_t>();
        if (reader.too_short() || length > file_.size()) break;
        if (opcode == Opcode::chunk_index && chunk > byte) nearest = std::min(nearest, chunk);
        at += record_head + length;
    }
    return nearest;
}

Expected<std::string> unpack_chunk(std::string_view content) {
    const auto chunk = parse_chunk(content);
    if (!chunk) return refuse("is damaged: " + chunk.error().why);
    Expected<std::string> bytes;
    if (chunk->compression.empty()) {
        bytes = std::string(chunk->records);
    } else if (chunk->compression == "zstd") {
        bytes = unpack_zstd(chunk->records);
    } else if (chunk->compression == "lz4") {
        bytes = unpack_lz4(chunk->records);
    } else {
        return refuse("is packed by " + quote(chunk->compression) + ", which is unknown");
    }
    if (bytes && (bytes->size() != chunk->size || (chunk->crc != 0 && crc32(*bytes) != chunk->crc)))
        return refuse("is damaged: its checksum is wrong");
    return bytes;
}

}  // namespace scipd::sim::mcap
