// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>

#include <nlohmann/json.hpp>

#include "sim/recording/compression/compression.h"
#include "sim/recording/json/scan_json.h"
#include "sim/recording/mcap/mcap.h"
#include "sim/recording/ros/block_recording.h"

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
    std::optional<std::uint64_t> take_record(std::uint64_t byte) override;
    std::optional<std::uint64_t> chunk_behind(std::uint64_t byte) override;
    void read_index();
    Expected<> take_content(Opcode opcode, std::uint64_t byte, std::uint64_t length);
    Expected<> take(Opcode opcode, std::string_view content);
    Expected<> take_channel(std::string_view content);
    void take_metadata(const mcap::Metadata& metadata);
    Expected<std::string> records_of(std::string block) override;
    bool take_record(ByteReader& records, Unpacked& unpacked) override;
    Next item_of(const Message& message, std::string_view data) override;
    Expected<RecordedItem> json_scan(std::size_t of, HostTime logged, std::string_view data);
    std::size_t stream_of(std::string_view topic, std::string_view suffix);

    bool in_summary_ = false;
    std::optional<std::set<std::uint64_t>> indexed_;
    bool knows_channels_ = false;  ///< by the summary
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
    if (walk(mcap::magic.size()) && !in_summary_)
        warn(file_.name() + " has no index: its recorder was stopped before it ended");
    begin(knows_channels_);
    return {};
}

std::optional<std::uint64_t> Mcap::take_record(std::uint64_t byte) {
    const std::uint64_t end_of_file = file_.size();
    const auto bytes = file_.read(byte, mcap::record_head);
    ByteReader reader(bytes ? std::string_view(*bytes) : std::string_view{});
    const auto opcode = static_cast<Opcode>(reader.number<std::uint8_t>());
    const auto length = reader.number<std::uint64_t>();
    // A file system that lost its power may leave zeros.
    if (reader.too_short() || opcode == Opcode{} || length > end_of_file - byte - mcap::record_head)
        return in_summary_ ? std::optional(end_of_file) : std::nullopt;
    in_summary_ |= opcode == Opcode::data_end || opcode == Opcode::footer;
    if (opcode == Opcode::footer) return end_of_file;
    knows_channels_ |= in_summary_ && opcode == Opcode::channel;
    if (const auto taken = take_content(opcode, byte, length); !taken)
        lose(file_.refuse_byte(byte, taken.error().why));
    return byte + mcap::record_head + length;
}

std::optional<std::uint64_t> Mcap::chunk_behind(std::uint64_t byte) {
    if (in_summary_) return std::nullopt;
    if (!indexed_) read_index();
    const auto chunk = indexed_->upper_bound(byte);
    if (chunk == indexed_->end()) return std::nullopt;
    return *chunk;
}

/// The beginnings of chunks, and of the index.
void Mcap::read_index() {
    constexpr std::uint64_t tail = 20 + mcap::magic.size();  // content of the footer
    indexed_.emplace();
    const auto end = file_.read(file_.size() - std::min(tail, file_.size()), tail);
    if (!end || end->size() < tail || !end->ends_with(mcap::magic)) return;
    const auto index = ByteReader(*end).number<std::uint64_t>();
    for (std::uint64_t at = index; at < file_.size();) {
        indexed_->insert(index);
        const auto bytes = file_.read(at, mcap::record_head + 3 * sizeof(std::uint64_t));
        if (!bytes) return;
        ByteReader reader(*bytes);
        const auto opcode = static_cast<Opcode>(reader.number<std::uint8_t>());
        const auto length = reader.number<std::uint64_t>();
        reader.skip(2 * sizeof(std::uint64_t));  // the times of its first and last message
        const auto chunk = reader.number<std::uint64_t>();
        if (reader.too_short() || length > file_.size()) return;
        if (opcode == Opcode::chunk_index && chunk < index) indexed_->insert(chunk);
        at += mcap::record_head + length;
    }
}

/// Takes a record of the file; of a chunk or a message the times alone.
Expected<> Mcap::take_content(Opcode opcode, std::uint64_t byte, std::uint64_t length) {
    constexpr std::uint64_t of_times = 24;
    const bool in_block = opcode == Opcode::chunk || opcode == Opcode::message;
    if (!in_block && opcode != Opcode::schema && opcode != Opcode::channel &&
        opcode != Opcode::metadata)
        return {};
    if (!in_block && length > largest_block) return refuse("the record is too large");
    const auto content =
        file_.read(byte + mcap::record_head, in_block ? std::min(of_times, length) : length);
    if (!content) return tl::unexpected(content.error());
    if (!in_block) return take(opcode, *content);
    Block block{.byte = byte, .size = mcap::record_head + length};
    ByteReader times(*content);
    if (opcode == Opcode::message) {
        times.skip(sizeof(mcap::Message::channel) + sizeof(mcap::Message::sequence));
        block.first = block.last = host_time(times.number<std::uint64_t>());
        add_loose(block);
    } else {
        block.first = host_time(times.number<std::uint64_t>());
        block.last = host_time(times.number<std::uint64_t>());
        add_chunk(block);
    }
    return {};
}

/// The records of a chunk once its checksum is right.
Expected<std::string> Mcap::records_of(std::string block) {
    if (!block.starts_with(static_cast<char>(Opcode::chunk))) return block;
    const auto chunk = mcap::parse_chunk(std::string_view(block).substr(mcap::record_head));
    if (!chunk) return refuse("is damaged: " + chunk.error().why);
    auto bytes = sim::unpack(chunk->compression, chunk->records, unpack_left_);
    if (bytes &&
        (bytes->size() != chunk->size || (chunk->crc != 0 && mcap::crc32(*bytes) != chunk->crc)))
        return refuse("is damaged: its checksum is wrong");
    return bytes;
}

bool Mcap::take_record(ByteReader& records, Unpacked& unpacked) {
    const auto opcode = static_cast<Opcode>(records.number<std::uint8_t>());
    const std::string_view content = records.take(records.number<std::uint64_t>());
    if (records.too_short() || opcode == Opcode{}) return false;
    const auto message = [&] {
        return mcap::parse_message(content).map([&](const mcap::Message& found) {
            if (has_topic(found.channel) || contents_.contains(found.channel))
                unpacked.add(host_time(found.log_ns), found.channel, found.data);
        });
    };
    if (const auto taken = opcode == Opcode::message ? message() : take(opcode, content); !taken)
        lose(file_.refuse_byte(unpacked.byte, taken.error().why));
    return true;
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
    if (contents_.contains(channel->id) || has_topic(channel->id)) return {};
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
        add_topic(channel->id, {topic, type, cdr ? RosEncoding::cdr : RosEncoding::ros1});
    } else {
        leave_out(topic, type);
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
    if (has_topic(message.channel)) return laser_item(message.channel, message.time, data);
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
