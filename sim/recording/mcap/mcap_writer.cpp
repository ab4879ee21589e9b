// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/mcap/mcap_writer.h"

#include <algorithm>

#include "sim/recording/compression/compression.h"

namespace scipd::sim::mcap {
namespace {

const char* name_of(Compression compression) {
    switch (compression) {
        case Compression::lz4:
            return "lz4";
        case Compression::zstd:
            return "zstd";
        case Compression::none:
            break;
    }
    return "";
}

std::string numbers_by_channel(const std::map<std::uint16_t, std::uint64_t>& numbers) {
    ByteWriter map;
    for (const auto& [channel, number] : numbers)
        map.number(channel).number(number);
    return map.bytes();
}

}  // namespace

Writer::Writer(const std::filesystem::path& path, WriterOptions options)
    : file_(path), options_(std::move(options)) {
    put(magic);
    put(record(Opcode::header, ByteWriter{}.text("").text(options_.library).bytes()));
    file_.flush();
}

std::uint16_t Writer::add_schema(std::string name, std::string encoding, std::string data) {
    const auto id = static_cast<std::uint16_t>(schemas_.size() + 1);
    schemas_.push_back({id, std::move(name), std::move(encoding), std::move(data)});
    put(schema_record(schemas_.back()));
    return id;
}

std::uint16_t Writer::add_channel(std::string topic, std::uint16_t schema, std::string encoding) {
    const auto id = static_cast<std::uint16_t>(channels_.size() + 1);
    channels_.push_back({id, schema, std::move(topic), std::move(encoding), {}});
    put(channel_record(channels_.back()));
    return id;
}

void Writer::add_metadata(const Metadata& metadata) {
    const std::string bytes = metadata_record(metadata);
    metadata_.push_back({file_.size(), bytes.size(), metadata.name});
    put(bytes);
    file_.flush();
}

void Writer::write(std::uint16_t channel, std::uint64_t log_ns, std::string_view data) {
    const bool first = records_.empty();
    first_ns_ = first ? log_ns : std::min(first_ns_, log_ns);
    last_ns_ = first ? log_ns : std::max(last_ns_, log_ns);
    places_[channel].push_back({log_ns, records_.size()});
    const auto sequence = static_cast<std::uint32_t>(++message_counts_[channel]);
    records_ += message_record({channel, sequence, log_ns, log_ns, data});
    const auto span = std::chrono::nanoseconds(last_ns_ - first_ns_);
    if (records_.size() >= options_.chunk_bytes || span >= options_.chunk_time) end_chunk();
}

void Writer::finish() {
    end_chunk();
    put(record(Opcode::data_end, ByteWriter{}.number(crc_.checksum()).bytes()));
    put_summary();
    file_.flush();
}

void Writer::put(std::string_view bytes) {
    crc_.process_bytes(bytes.data(), bytes.size());
    file_.write(bytes);
}

void Writer::end_chunk() {
    if (records_.empty()) return;
    const std::string bytes = pack(name_of(options_.compression), records_);
    const Chunk chunk{
        first_ns_, last_ns_, records_.size(), crc32(records_), name_of(options_.compression),
        bytes};
    ChunkIndex index{chunk, bytes.size(), file_.size(), 0, {}, 0};
    index.chunk.records = {};
    put(chunk_record(chunk));
    index.length = file_.size() - index.offset;
    put_message_indexes(index);
    chunks_.push_back(std::move(index));
    records_.clear();
    places_.clear();
    file_.flush();
}

void Writer::put_message_indexes(ChunkIndex& index) {
    const std::uint64_t begin = file_.size();
    for (const auto& [channel, places] : places_) {
        ByteWriter list;
        for (const Place& place : places)
            list.number(place.log_ns).number(place.offset);
        index.message_indexes[channel] = file_.size();
        put(record(Opcode::message_index, ByteWriter{}.number(channel).text(list.bytes()).bytes()));
    }
    index.message_indexes_length = file_.size() - begin;
}

void Writer::put_summary() {
    crc_.reset();
    const std::uint64_t start = file_.size();
    std::vector<Group> groups;
    const auto put_group = [&](Opcode opcode, const auto& all, const auto& record_of) {
        const std::uint64_t begin = file_.size();
        for (const auto& one : all)
            put(record_of(one));
        if (file_.size() > begin) groups.push_back({opcode, begin, file_.size() - begin});
    };
    put_group(Opcode::schema, schemas_, schema_record);
    put_group(Opcode::channel, channels_, channel_record);
    put_group(Opcode::statistics, std::vector{statistics()}, [](const auto& text) { return text; });
    put_group(Opcode::chunk_index, chunks_, chunk_index);
    put_group(Opcode::metadata_index, metadata_, [](const MetadataIndex& index) {
        ByteWriter content;
        content.number(index.offset).number(index.length).text(index.name);
        return record(Opcode::metadata_index, content.bytes());
    });
    const std::uint64_t offsets_start = file_.size();
    for (const Group& group : groups) {
        ByteWriter content;
        content.number(static_cast<std::uint8_t>(group.opcode));
        put(record(Opcode::summary_offset,
                   content.number(group.start).number(group.length).bytes()));
    }
    // The sum is of all up to itself, with the footer's head.
    ByteWriter footer;
    footer.number(start).number(offsets_start).number(std::uint32_t{0});
    const std::string bytes = record(Opcode::footer, footer.bytes());
    put(std::string_view(bytes).substr(0, bytes.size() - sizeof(std::uint32_t)));
    put(ByteWriter{}.number(crc_.checksum()).bytes());
    put(magic);
}

std::string Writer::statistics() const {
    std::uint64_t count = 0;
    for (const auto& [channel, messages] : message_counts_)
        count += messages;
    std::uint64_t first = chunks_.empty() ? 0 : chunks_.front().chunk.first_ns;
    std::uint64_t last = 0;
    for (const ChunkIndex& index : chunks_) {
        first = std::min(first, index.chunk.first_ns);
        last = std::max(last, index.chunk.last_ns);
    }
    const auto number = [](std::size_t size) { return static_cast<std::uint32_t>(size); };
    ByteWriter content;
    content.number(count).number(static_cast<std::uint16_t>(schemas_.size()));
    content.number(number(channels_.size())).number(std::uint32_t{0});  // no attachments
    content.number(number(metadata_.size())).number(number(chunks_.size()));
    content.number(first).number(last).text(numbers_by_channel(message_counts_));
    return record(Opcode::statistics, content.bytes());
}

std::string Writer::chunk_index(const ChunkIndex& index) {
    ByteWriter content;
    content.number(index.chunk.first_ns).number(index.chunk.last_ns);
    content.number(index.offset).number(index.length);
    content.text(numbers_by_channel(index.message_indexes)).number(index.message_indexes_length);
    content.text(index.chunk.compression).number(index.packed_size).number(index.chunk.size);
    return record(Opcode::chunk_index, content.bytes());
}

}  // namespace scipd::sim::mcap
