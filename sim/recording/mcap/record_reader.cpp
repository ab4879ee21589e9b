// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/mcap/record_reader.h"

#include "sim/recording/compression/compression.h"
#include "sim/text/quote.h"

namespace scipd::sim::mcap {
namespace {

/// Others are skipped: indexes, attachments, and what later versions may have.
bool is_wanted(Opcode opcode) {
    switch (opcode) {
        case Opcode::header:
        case Opcode::schema:
        case Opcode::channel:
        case Opcode::message:
        case Opcode::chunk:
        case Opcode::metadata:
            return true;
        default:
            return false;
    }
}

}  // namespace

Expected<> RecordReader::check_magic() {
    const auto beginning = file_.read(0, magic.size());
    if (!beginning) return tl::unexpected(beginning.error());
    if (*beginning == magic) return {};
    return file_.refuse_byte(0, "is no MCAP file of version 0: it begins otherwise");
}

Expected<std::optional<Record>> RecordReader::next() {
    for (;;) {
        if (!in_chunk_.at_end()) return next_in_chunk();
        auto record = next_in_file();
        if (!record || !*record || (*record)->opcode != Opcode::chunk) return record;
        if (const auto unpacked = unpack((*record)->content); !unpacked)
            return file_.refuse_byte(byte_, "the chunk " + unpacked.error().why);
    }
}

Expected<std::optional<Record>> RecordReader::next_in_file() {
    for (;;) {
        byte_ = next_byte_;
        const auto head = file_.read(byte_, record_head);
        if (!head) return tl::unexpected(head.error());
        if (head->empty()) return ends("has no index: its writer was stopped before it ended");
        ByteReader reader(*head);
        const auto opcode = static_cast<Opcode>(reader.number<std::uint8_t>());
        const auto length = reader.number<std::uint64_t>();
        const auto begin = byte_ + record_head;
        // A file system that lost its power may leave zeros.
        if (reader.too_short() || opcode == Opcode{} || begin > file_.size() ||
            length > file_.size() - begin)
            return ends("ends within the record at byte " + std::to_string(byte_) +
                        ", which is lost: its writer was stopped there");
        if (opcode == Opcode::data_end || opcode == Opcode::footer) return std::nullopt;
        next_byte_ = begin + length;
        if (!is_wanted(opcode)) continue;
        if (opcode == Opcode::chunk && skip_to_ns_ > 0) {
            const auto early = is_early(begin);
            if (!early) return tl::unexpected(early.error());
            if (*early) continue;
        }
        if (length > largest_block)
            return file_.refuse_byte(
                byte_, "the record has " + std::to_string(length) + " bytes, more than this reads");
        auto content = file_.read(begin, length);
        if (!content) return tl::unexpected(content.error());
        content_ = std::move(*content);
        return Record{opcode, byte_, content_};
    }
}

// A chunk begins with the times of its first and its last message.
Expected<bool> RecordReader::is_early(std::uint64_t chunk) {
    const auto times = file_.read(chunk, 2 * sizeof(std::uint64_t));
    if (!times) return tl::unexpected(times.error());
    ByteReader reader(*times);
    reader.skip(sizeof(std::uint64_t));
    const auto last_ns = reader.number<std::uint64_t>();
    return !reader.too_short() && last_ns < skip_to_ns_;
}

Expected<std::optional<Record>> RecordReader::next_in_chunk() {
    const auto opcode = static_cast<Opcode>(in_chunk_.number<std::uint8_t>());
    const std::string_view content = in_chunk_.take(in_chunk_.number<std::uint64_t>());
    if (!in_chunk_.too_short()) return Record{opcode, byte_, content};
    in_chunk_ = ByteReader({});
    return file_.refuse_byte(byte_, "the chunk that begins here ends within a record");
}

Expected<> RecordReader::unpack(std::string_view content) {
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
    if (!bytes) return tl::unexpected(bytes.error());
    if (bytes->size() != chunk->size || (chunk->crc != 0 && crc32(*bytes) != chunk->crc))
        return refuse("is damaged: its sum is wrong");
    chunk_ = std::move(*bytes);
    in_chunk_ = ByteReader(chunk_);
    return {};
}

std::optional<Record> RecordReader::ends(const std::string& how) {
    lost_ = file_.name() + " " + how;
    next_byte_ = file_.size();
    return std::nullopt;
}

}  // namespace scipd::sim::mcap
