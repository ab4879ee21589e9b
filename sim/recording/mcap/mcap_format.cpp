// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/mcap/mcap_format.h"

#include <boost/crc.hpp>

#include "sim/recording/file/byte_reader.h"

namespace scipd::sim::mcap {
namespace {

constexpr auto ends_too_early = "a record ends before its last field";

template <class Value>
Expected<Value> checked(Value value, const ByteReader& reader) {
    if (reader.too_short()) return refuse(ends_too_early);
    return value;
}

Entries take_map(ByteReader& reader) {
    ByteReader pairs(reader.text());
    Entries entries;
    while (!pairs.at_end() && !pairs.too_short()) {
        std::string key(pairs.text());
        std::string value(pairs.text());
        entries.push_back({std::move(key), std::move(value)});
    }
    return entries;
}

std::string map_of(const Entries& entries) {
    ByteWriter pairs;
    for (const Entry& entry : entries)
        pairs.text(entry.key).text(entry.value);
    return pairs.bytes();
}

}  // namespace

Expected<Schema> parse_schema(std::string_view content) {
    ByteReader reader(content);
    Schema schema;
    schema.id = reader.number<std::uint16_t>();
    schema.name = reader.text();
    schema.encoding = reader.text();
    schema.data = reader.text();
    return checked(std::move(schema), reader);
}

Expected<Channel> parse_channel(std::string_view content) {
    ByteReader reader(content);
    Channel channel;
    channel.id = reader.number<std::uint16_t>();
    channel.schema = reader.number<std::uint16_t>();
    channel.topic = reader.text();
    channel.encoding = reader.text();
    channel.metadata = take_map(reader);
    return checked(std::move(channel), reader);
}

Expected<Message> parse_message(std::string_view content) {
    ByteReader reader(content);
    Message message;
    message.channel = reader.number<std::uint16_t>();
    message.sequence = reader.number<std::uint32_t>();
    message.log_ns = reader.number<std::uint64_t>();
    message.publish_ns = reader.number<std::uint64_t>();
    message.data = reader.rest();
    return checked(message, reader);
}

Expected<Chunk> parse_chunk(std::string_view content) {
    ByteReader reader(content);
    Chunk chunk;
    chunk.first_ns = reader.number<std::uint64_t>();
    chunk.last_ns = reader.number<std::uint64_t>();
    chunk.size = reader.number<std::uint64_t>();
    chunk.crc = reader.number<std::uint32_t>();
    chunk.compression = reader.text();
    chunk.records = reader.take(reader.number<std::uint64_t>());
    return checked(chunk, reader);
}

Expected<Metadata> parse_metadata(std::string_view content) {
    ByteReader reader(content);
    Metadata metadata;
    metadata.name = reader.text();
    metadata.entries = take_map(reader);
    return checked(std::move(metadata), reader);
}

std::string record(Opcode opcode, std::string_view content) {
    return ByteWriter{}
        .number(static_cast<std::uint8_t>(opcode))
        .number(static_cast<std::uint64_t>(content.size()))
        .raw(content)
        .bytes();
}

std::string schema_record(const Schema& schema) {
    ByteWriter content;
    content.number(schema.id).text(schema.name).text(schema.encoding).text(schema.data);
    return record(Opcode::schema, content.bytes());
}

std::string channel_record(const Channel& channel) {
    ByteWriter content;
    content.number(channel.id).number(channel.schema);
    content.text(channel.topic).text(channel.encoding).text(map_of(channel.metadata));
    return record(Opcode::channel, content.bytes());
}

std::string message_record(const Message& message) {
    ByteWriter content;
    content.number(message.channel).number(message.sequence);
    content.number(message.log_ns).number(message.publish_ns).raw(message.data);
    return record(Opcode::message, content.bytes());
}

std::string chunk_record(const Chunk& chunk) {
    ByteWriter content;
    content.number(chunk.first_ns).number(chunk.last_ns).number(chunk.size).number(chunk.crc);
    content.text(chunk.compression);
    content.number(static_cast<std::uint64_t>(chunk.records.size())).raw(chunk.records);
    return record(Opcode::chunk, content.bytes());
}

std::string metadata_record(const Metadata& metadata) {
    ByteWriter content;
    content.text(metadata.name).text(map_of(metadata.entries));
    return record(Opcode::metadata, content.bytes());
}

std::uint32_t crc32(std::string_view bytes) {
    boost::crc_32_type sum;
    sum.process_bytes(bytes.data(), bytes.size());
    return sum.checksum();
}

}  // namespace scipd::sim::mcap
