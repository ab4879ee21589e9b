// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include <nlohmann/json.hpp>

#include "sim/recording/json/scan_json.h"
#include "sim/recording/mcap/mcap.h"
#include "sim/recording/mcap/record_reader.h"
#include "sim/recording/mcap/scip_channels.h"
#include "sim/recording/ros/laser_topics.h"
#include "sim/recording/values/identity_entries.h"
#include "sim/recording/values/left_out.h"

namespace scipd::sim {
namespace {

using mcap::Opcode;
using mcap::Record;

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

/// Whether it is a time that says nothing.
HostTime time_of(const nlohmann::json& message, HostTime received) {
    const auto timestamp = message.find("timestamp");
    if (timestamp == message.end() || !timestamp->is_object()) return received;
    const auto part = [&](const char* key) {
        const auto found = timestamp->find(key);
        return found != timestamp->end() && found->is_number_unsigned()
                   ? found->get<std::uint64_t>()
                   : 0;
    };
    const std::uint64_t seconds = part("sec");
    if (seconds == 0 || seconds > 0xFFFFFFFF) return received;
    return host_time_at(static_cast<std::int64_t>(seconds),
                        static_cast<std::int64_t>(part("nsec") % 1'000'000'000));
}

class Mcap final : public Recording {
  public:
    explicit Mcap(InputFile file) : Recording("mcap"), reader_(std::move(file)) {}

    /// Reads up to the first message, so that the streams are known.
    Expected<> begin() {
        if (auto checked = reader_.check_magic(); !checked) return checked;
        const auto record = read_to_message();
        if (!record) return tl::unexpected(record.error());
        first_ = *record;
        if (const auto message = *record ? mcap::parse_message((*record)->content)
                                         : Expected<mcap::Message>(refuse("there is none")))
            begin_ns_ = message->log_ns;
        return {};
    }

    void skip_ahead(std::chrono::nanoseconds since_first) override {
        reader_.skip_to(begin_ns_ + static_cast<std::uint64_t>(since_first.count()));
    }

  private:
    Next do_next() override;
    Expected<std::optional<Record>> read_to_message();
    Expected<> take(const Record& record);
    Expected<> take_channel(const Record& record);
    void take_metadata(const mcap::Metadata& metadata);
    Next item_of(const mcap::Message& message);
    Expected<RecordedItem> json_scan(const JsonScans& channel, const mcap::Message& message);
    std::size_t stream_of(std::string_view topic, std::string_view suffix);

    mcap::RecordReader reader_;
    std::optional<std::optional<Record>> first_;  ///< a message that was read and not yet given
    std::uint64_t begin_ns_ = 0;                  ///< the time of the first message
    std::map<std::uint16_t, mcap::Schema> schemas_;
    std::map<std::uint16_t, Content> contents_;
    std::map<std::string, std::size_t> streams_by_prefix_;
    std::map<std::string, ScannerIdentity> identities_;  ///< by prefix
    LeftOut left_out_;
    LaserTopics topics_{{[this](RecordedStream one) { return add_stream(std::move(one)); },
                         [this](std::size_t index) -> RecordedStream& { return stream(index); }}};
};

Recording::Next Mcap::do_next() {
    for (;;) {
        Expected<std::optional<Record>> record;
        if (first_) {
            record = *std::exchange(first_, std::nullopt);
        } else {
            record = read_to_message();
        }
        if (!record) return tl::unexpected(record.error());
        if (!*record) break;
        const auto message = mcap::parse_message((*record)->content);
        auto item = message ? item_of(*message) : tl::unexpected(message.error());
        if (!item) return reader_.file().refuse_byte((*record)->byte, item.error().why);
        if (*item) return item;
    }
    if (!reader_.lost().empty()) warn(reader_.lost());
    if (!left_out_.empty()) warn(reader_.file().name() + ": " + left_out_.sentence());
    return std::nullopt;
}

Expected<std::optional<Record>> Mcap::read_to_message() {
    for (;;) {
        auto record = reader_.next();
        if (!record || !*record || (*record)->opcode == Opcode::message) return record;
        if (const auto taken = take(**record); !taken)
            return reader_.file().refuse_byte((*record)->byte, taken.error().why);
    }
}

Expected<> Mcap::take(const Record& record) {
    if (record.opcode == Opcode::schema) {
        return mcap::parse_schema(record.content).map([&](mcap::Schema schema) {
            schemas_[schema.id] = std::move(schema);
        });
    }
    if (record.opcode == Opcode::metadata) {
        return mcap::parse_metadata(record.content).map([&](const mcap::Metadata& metadata) {
            take_metadata(metadata);
        });
    }
    return record.opcode == Opcode::channel ? take_channel(record) : Expected<>{};
}

Expected<> Mcap::take_channel(const Record& record) {
    const auto channel = mcap::parse_channel(record.content);
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
            left_out_.add(topic, type);
    } else {
        left_out_.add(topic, type);
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

Recording::Next Mcap::item_of(const mcap::Message& message) {
    const HostTime received = host_time(message.log_ns);
    if (topics_.has(message.channel)) {
        return topics_.item(message.channel, received, message.data);
    }
    const auto found = contents_.find(message.channel);
    if (found == contents_.end()) return std::nullopt;
    if (const auto* const wire = std::get_if<WireBytes>(&found->second)) {
        return RecordedItem{wire->stream,
                            RecordedBytes{wire->way, received, std::string(message.data)}};
    }
    return json_scan(std::get<JsonScans>(found->second), message);
}

Expected<RecordedItem> Mcap::json_scan(const JsonScans& channel, const mcap::Message& message) {
    const auto object = nlohmann::json::parse(message.data, nullptr, false);
    if (object.is_discarded()) return refuse("a scan is no JSON");
    auto scan = scan_in(object);
    if (!scan) return tl::unexpected(scan.error());
    scan->host_time = time_of(object, host_time(message.log_ns));
    return RecordedItem{channel.stream, std::move(*scan)};
}

}  // namespace

Expected<std::unique_ptr<Recording>> open_mcap(InputFile file) {
    auto recording = std::make_unique<Mcap>(std::move(file));
    if (const auto begun = recording->begin(); !begun) return tl::unexpected(begun.error());
    return recording;
}

}  // namespace scipd::sim
