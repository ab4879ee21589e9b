// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include <nlohmann/json.hpp>

#include "sim/recording/compression/compression.h"
#include "sim/recording/file/byte_reader.h"
#include "sim/recording/json/scan_json.h"
#include "sim/recording/mcap/mcap.h"
#include "sim/recording/mcap/record_reader.h"
#include "sim/recording/mcap/scip_channels.h"
#include "sim/recording/ros/block_recording.h"
#include "sim/recording/values/identity_entries.h"

namespace scipd::sim {
namespace {

using mcap::Opcode;

/// The messages of a channel: scans as JSON, or bytes that went this way.
struct JsonScans {
    std::size_t stream;
};
struct WireBytes {
    std::size_t stream;
    Way way;
};
using Content = std::variant<JsonScans, WireBytes>;

HostTime host_time(std::uint64_t unix_ns) {
    return HostTime(std::chrono::nanoseconds(static_cast<std::int64_t>(unix_ns)));
}

/// The time that a scan in JSON has; nullopt where it is 0.
std::optional<HostTime> time_of(const nlohmann::json& message) {
    const auto timestamp = message.find("timestamp");
    if (timestamp == message.end() || !timestamp->is_object()) return std::nullopt;
    const auto part = [&](const char* key) {
        const auto found = timestamp->find(key);
        return found != timestamp->end() && found->is_number_unsigned()
                   ? found->get<std::uint64_t>()
                   : 0;
    };
    const std::uint64_t seconds = part("sec");
    if (seconds == 0 || seconds > 0xFFFFFFFF) return std::nullopt;
    return host_time_at(static_cast<std::int64_t>(seconds),
                        static_cast<std::int64_t>(part("nsec") % 1'000'000'000));
}

class Mcap final : public BlockRecording {
  public:
    explicit Mcap(InputFile file) : BlockRecording("mcap", std::move(file)) {}

    /// Finds the chunks by their heads, without unpacking them.
    Expected<> read_layout();

  private:
    Expected<> take_head(const mcap::RecordHead& head);
    Expected<> take(Opcode opcode, std::string_view content);
    Expected<> take_channel(std::string_view content);
    Expected<> take_message(std::string_view content, Unpacked& unpacked) const;
    void take_metadata(const mcap::Metadata& metadata);
    void unpack(const Block& block, Unpacked& unpacked) override;
    Next item_of(const Message& message, std::string_view data) override;
    Expected<RecordedItem> json_scan(std::size_t of, HostTime logged, std::string_view data);
    std::size_t stream_of(std::string_view topic, std::string_view suffix);

    std::map<std::uint16_t, mcap::Schema> schemas_;
    std::map<std::uint16_t, Content> contents_;
    std::map<std::string, std::size_t> streams_by_prefix_;
    std::map<std::string, ScannerIdentity> identities_;  ///< by prefix
};

Expected<> Mcap::read_layout() {
    const auto beginning = file_.read(0, mcap::magic.size());
    if (!beginning) return tl::unexpected(beginning.error());
    if (*beginning != mcap::magic)
        return file_.refuse_byte(0, "is no MCAP file of version 0: it begins otherwise");
    mcap::RecordReader reader(file_, [this](const auto& why) { lose(why); });
    bool knows_channels = false;
    for (;;) {
        const auto head = reader.next();
        if (!head) return tl::unexpected(head.error());
        if (!*head) break;
        knows_channels |= reader.in_summary() && (*head)->opcode == Opcode::channel;
        if (const auto taken = take_head(**head); !taken)
            lose(file_.refuse_byte((*head)->byte, taken.error().why));
    }
    if (!reader.lost().empty()) warn(file_.name() + " " + reader.lost());
    begin(knows_channels);
    return {};
}

Expected<> Mcap::take_head(const mcap::RecordHead& head) {
    constexpr std::size_t enough = 24;  // for the times of a chunk or a message
    const bool is_short = head.opcode == Opcode::chunk || head.opcode == Opcode::message;
    if (!is_short && head.opcode != Opcode::schema && head.opcode != Opcode::channel &&
        head.opcode != Opcode::metadata)
        return {};
    if (!is_short && head.length > largest_block) return refuse("the record is too large");
    const auto content = file_.read(
        head.begin, is_short ? std::min<std::uint64_t>(enough, head.length) : head.length);
    if (!content) return tl::unexpected(content.error());
    if (!is_short) return take(head.opcode, *content);
    Block block{.byte = head.byte, .size = mcap::record_head + head.length};
    ByteReader times(*content);
    if (head.opcode == Opcode::message) {
        block.first = block.last =
            mcap::parse_message(*content)
                .map([](const auto& message) { return host_time(message.log_ns); })
                .value_or(HostTime{});
        add_loose(block);
    } else {
        block.first = host_time(times.number<std::uint64_t>());
        block.last = host_time(times.number<std::uint64_t>());
        add_chunk(block);
    }
    return {};
}

void Mcap::unpack(const Block& block, Unpacked& unpacked) {
    const std::string size = std::to_string(block.size) + " bytes ";
    if (block.size > largest_block)
        return lose(file_.refuse_byte(block.byte, "the record of " + size + "is too large"));
    auto bytes = file_.read(block.byte, block.size);
    const bool is_chunk = bytes && bytes->starts_with(static_cast<char>(Opcode::chunk));
    if (is_chunk) bytes = mcap::unpack_chunk(std::string_view(*bytes).substr(mcap::record_head));
    if (!bytes) {
        return lose(file_.refuse_byte(block.byte, "the chunk of " + size + bytes.error().why));
    }
    unpacked.bytes = std::move(*bytes);
    ByteReader reader(unpacked.bytes);
    while (!reader.at_end()) {
        const auto opcode = static_cast<Opcode>(reader.number<std::uint8_t>());
        const std::string_view content = reader.take(reader.number<std::uint64_t>());
        if (reader.too_short())
            return lose(
                file_.refuse_byte(block.byte, "the chunk of " + size + "ends within a record"));
        const auto taken =
            opcode == Opcode::message ? take_message(content, unpacked) : take(opcode, content);
        if (!taken) lose(file_.refuse_byte(block.byte, taken.error().why));
    }
}

Expected<> Mcap::take_message(std::string_view content, Unpacked& unpacked) const {
    return mcap::parse_message(content).map([&](const mcap::Message& message) {
        if (!topics_.has(message.channel) && !contents_.contains(message.channel)) return;
        const auto begin = static_cast<std::uint32_t>(message.data.data() - unpacked.bytes.data());
        unpacked.messages.push_back({host_time(message.log_ns), message.channel, begin,
                                     static_cast<std::uint32_t>(message.data.size())});
    });
}

Expected<> Mcap::take(Opcode opcode, std::string_view content) {
    if (opcode == Opcode::schema) {
        return mcap::parse_schema(content).map(
            [&](mcap::Schema schema) { schemas_[schema.id] = std::move(schema); });
    }
    if (opcode == Opcode::metadata) {
        return mcap::parse_metadata(content).map(
            [&](const mcap::Metadata& metadata) { take_metadata(metadata); });
    }
    return opcode == Opcode::channel ? take_channel(content) : Expected<>{};
}

Expected<> Mcap::take_channel(std::string_view content) {
    const auto channel = mcap::parse_channel(content);
    if (!channel) return tl::unexpected(channel.error());
    const std::string& topic = channel->topic;
    const auto schema = schemas_.find(channel->schema);
    const std::string type = schema == schemas_.end() ? channel->encoding : schema->second.name;
    if (contents_.contains(channel->id) || topics_.has(channel->id)) return {};
    const bool wire = channel->encoding == mcap::wire_encoding;
    const bool to_scanner = topic.ends_with(mcap::to_scanner_topic);
    if (wire && (to_scanner || topic.ends_with(mcap::from_scanner_topic))) {
        const std::size_t of =
            stream_of(topic, to_scanner ? mcap::to_scanner_topic : mcap::from_scanner_topic);
        stream(of).has_bytes = true;
        contents_[channel->id] = WireBytes{of, to_scanner ? Way::to_scanner : Way::from_scanner};
    } else if (channel->encoding == "json" && type == mcap::scan_schema_name) {
        const std::size_t of = stream_of(topic, mcap::scan_topic);
        stream(of).has_scans = true;
        stream(of).type = type;
        contents_[channel->id] = JsonScans{of};
    } else if (const bool cdr = channel->encoding == "cdr"; cdr || channel->encoding == "ros1") {
        if (!topics_.add(channel->id, {topic, type, cdr ? RosEncoding::cdr : RosEncoding::ros1}))
            leave_out(file_.name(), topic, type);
    } else {
        leave_out(file_.name(), topic, type);
    }
    return {};
}

void Mcap::take_metadata(const mcap::Metadata& metadata) {
    if (metadata.name != mcap::metadata_name) return;
    const std::string prefix = value_of(metadata.entries, "prefix");
    identities_[prefix] = identity_in(metadata.entries);
    const auto found = streams_by_prefix_.find(prefix);
    if (found != streams_by_prefix_.end()) stream(found->second).identity = identities_[prefix];
}

std::size_t Mcap::stream_of(std::string_view topic, std::string_view suffix) {
    if (topic.ends_with(suffix)) topic.remove_suffix(suffix.size());
    const std::string prefix(topic);
    const auto [found, is_new] = streams_by_prefix_.try_emplace(prefix, 0);
    if (!is_new) return found->second;
    RecordedStream stream{.name = prefix.empty() ? "scanner" : prefix,
                          .type = std::string(mcap::wire_encoding),
                          .has_scans = false};
    if (const auto known = identities_.find(prefix); known != identities_.end())
        stream.identity = known->second;
    return found->second = add_stream(std::move(stream));
}

Recording::Next Mcap::item_of(const Message& message, std::string_view data) {
    if (topics_.has(message.channel)) return BlockRecording::item_of(message, data);
    const Content& content = contents_.at(static_cast<std::uint16_t>(message.channel));
    if (const auto* const wire = std::get_if<WireBytes>(&content))
        return RecordedItem{wire->stream, RecordedBytes{wire->way, message.time, std::string(data)},
                            message.time};
    return json_scan(std::get<JsonScans>(content).stream, message.time, data);
}

Expected<RecordedItem> Mcap::json_scan(std::size_t of, HostTime logged, std::string_view data) {
    const auto object = nlohmann::json::parse(data, nullptr, false);
    if (object.is_discarded()) return refuse("a scan is no JSON");
    auto scan = scan_in(object);
    if (!scan) return tl::unexpected(scan.error());
    const auto stamp = time_of(object);
    scan->host_time = stamp.value_or(logged);
    return RecordedItem{of, std::move(*scan), logged, stamp.has_value()};
}

}  // namespace

Expected<std::unique_ptr<Recording>> open_mcap(InputFile file) {
    auto recording = std::make_unique<Mcap>(std::move(file));
    if (const auto read = recording->read_layout(); !read) return tl::unexpected(read.error());
    return recording;
}

}  // namespace scipd::sim
