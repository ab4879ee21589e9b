// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "sim/recording/compression/compression.h"
#include "sim/recording/file/byte_reader.h"
#include "sim/recording/ros/bags.h"
#include "sim/recording/ros/block_recording.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

constexpr std::string_view bag_magic = "#ROSBAG V2.0\n";

enum class Operation : std::uint8_t {
    message = 2,
    bag_header,
    index,
    chunk,
    chunk_info,
    connection
};

/// The fields of a record's header, NAME=VALUE each.
class BagFields {
  public:
    explicit BagFields(std::string_view bytes) {
        ByteReader reader(bytes);
        while (!reader.at_end() && !reader.too_short()) {
            const std::string_view field = reader.text();
            const std::size_t equals = field.find('=');
            if (equals == field.npos) continue;
            values_[std::string(field.substr(0, equals))] = field.substr(equals + 1);
        }
    }

    [[nodiscard]] std::string text(const std::string& name) const {
        const auto found = values_.find(name);
        return found == values_.end() ? std::string{} : std::string(found->second);
    }
    template <class Number>
    [[nodiscard]] Number number(const std::string& name) const {
        const auto found = values_.find(name);
        return found == values_.end() ? Number{} : ByteReader(found->second).number<Number>();
    }
    [[nodiscard]] Operation operation() const {
        return static_cast<Operation>(number<std::uint8_t>("op"));
    }

  private:
    std::map<std::string, std::string_view> values_;
};

/// Seconds, then nanoseconds, of 32 bits each.
HostTime bag_time(const BagFields& fields, const std::string& name) {
    const auto both = fields.number<std::uint64_t>(name);
    return host_time_at(both & 0xFFFFFFFF, both >> 32);
}

/// A record as it stands in the file.
struct FileRecord {
    std::string header;
    std::uint64_t data_begin = 0;
    std::uint64_t data_size = 0;

    [[nodiscard]] std::uint64_t end() const { return data_begin + data_size; }
};

class Bag final : public BlockRecording {
  public:
    explicit Bag(InputFile file) : BlockRecording("bag", std::move(file)) {}

    /// Finds the chunks and their times, with the index of a bag that was closed.
    void read_layout();

  private:
    /// The record that begins at this byte; nullopt where the file ends within it, and where none
    /// begins there.
    std::optional<FileRecord> read_head(std::uint64_t byte);
    void read_chunk_infos();
    std::optional<std::uint64_t> take_record(std::uint64_t byte) override;
    std::optional<std::uint64_t> chunk_behind(std::uint64_t byte) override;
    void set_times(Block& chunk);
    void add_connection(const BagFields& fields, std::string_view data);
    Expected<std::string> records_of(std::string block) override;
    bool take_record(ByteReader& records, Unpacked& unpacked) override;

    std::map<std::uint64_t, Block> infos_;  ///< by the byte where the chunk begins
    bool knows_connections_ = false;        ///< from outside of chunks
};

void Bag::read_layout() {
    read_chunk_infos();
    walk(bag_magic.size());
    for (Block& block : blocks_)
        set_times(block);
    begin(knows_connections_);
}

std::optional<std::uint64_t> Bag::chunk_behind(std::uint64_t byte) {
    const auto chunk = infos_.upper_bound(byte);
    if (chunk == infos_.end()) return std::nullopt;
    return chunk->first;
}

std::optional<FileRecord> Bag::read_head(std::uint64_t byte) {
    constexpr std::size_t longest_header = std::size_t{1} << 20;
    constexpr std::size_t length = sizeof(std::uint32_t);
    const auto beginning = file_.read(byte, length);
    if (!beginning || beginning->size() < length) return std::nullopt;
    const auto header_size = ByteReader(*beginning).number<std::uint32_t>();
    if (header_size > longest_header) return std::nullopt;
    const auto rest = file_.read(byte + length, header_size + length);
    if (!rest || rest->size() < header_size + length) return std::nullopt;
    ByteReader reader(*rest);
    FileRecord record;
    record.header = reader.take(header_size);
    record.data_size = reader.number<std::uint32_t>();
    record.data_begin = byte + header_size + 2 * length;
    const BagFields fields(record.header);
    const Operation operation = fields.operation();
    if (operation < Operation::message || operation > Operation::connection) return std::nullopt;
    // Recorders of 2010 wrote a wrong size. A time and an offset make an entry.
    constexpr std::uint64_t index_entry = 12;
    if (operation == Operation::index)
        record.data_size = fields.number<std::uint32_t>("count") * index_entry;
    return record;
}

/// They stand behind the chunks; the first record of the file says where.
void Bag::read_chunk_infos() {
    const auto first = read_head(bag_magic.size());
    if (!first) return;
    auto byte = BagFields(first->header).number<std::uint64_t>("index_pos");
    while (byte > bag_magic.size() && byte < file_.size()) {
        const auto record = read_head(byte);
        if (!record) return;
        const BagFields fields(record->header);
        if (fields.operation() == Operation::chunk_info)
            infos_[fields.number<std::uint64_t>("chunk_pos")] = {
                .first = bag_time(fields, "start_time"), .last = bag_time(fields, "end_time")};
        byte = record->end();
    }
}

std::optional<std::uint64_t> Bag::take_record(std::uint64_t byte) {
    const auto record = read_head(byte);
    if (!record || record->end() > file_.size()) return std::nullopt;
    const BagFields fields(record->header);
    Block block{.byte = byte, .size = record->end() - byte};
    if (fields.operation() == Operation::chunk) {
        add_chunk(block);
    } else if (fields.operation() == Operation::message) {
        block.first = block.last = bag_time(fields, "time");
        add_loose(block);
    } else if (fields.operation() == Operation::connection && record->data_size <= largest_block) {
        const auto data = file_.read(record->data_begin, record->data_size);
        if (data) add_connection(fields, *data);
        knows_connections_ = true;
    }
    return record->end();
}

/// The chunks, by the index; those of a bag that was not closed are unpacked to find their times.
void Bag::set_times(Block& block) {
    if (block.first != HostTime{}) return;
    if (const auto info = infos_.find(block.byte); info != infos_.end()) {
        block.first = info->second.first;
        block.last = info->second.last;
        return;
    }
    const Unpacked unpacked = unpack(block);
    if (unpacked.messages.empty()) return;
    const auto [first, last] = std::ranges::minmax(unpacked.messages, {}, &Message::time);
    block.first = first.time;
    block.last = last.time;
}

void Bag::add_connection(const BagFields& fields, std::string_view data) {
    add_topic(fields.number<std::uint32_t>("conn"),
              {fields.text("topic"), BagFields(data).text("type"), RosEncoding::ros1});
}

Expected<std::string> Bag::records_of(std::string block) {
    ByteReader head(block);
    const BagFields fields(head.text());
    if (fields.operation() != Operation::chunk) return block;
    return sim::unpack(fields.text("compression"), head.text(), unpack_left_);
}

bool Bag::take_record(ByteReader& records, Unpacked& unpacked) {
    const std::string_view header = records.text();
    const std::string_view data = records.text();
    if (records.too_short() || header.empty()) return false;
    const BagFields fields(header);
    const auto connection = fields.number<std::uint32_t>("conn");
    if (fields.operation() == Operation::connection) add_connection(fields, data);
    if (fields.operation() == Operation::message && has_topic(connection))
        unpacked.add(bag_time(fields, "time"), connection, data);
    return true;
}

}  // namespace

Expected<std::unique_ptr<Recording>> open_bag(InputFile file) {
    const auto beginning = file.read(0, bag_magic.size());
    if (!beginning) return tl::unexpected(beginning.error());
    if (*beginning != bag_magic) {
        const std::string_view line = std::string_view(*beginning).substr(0, beginning->find('\n'));
        if (!line.starts_with("#ROSRECORD") && !line.starts_with("#ROSBAG V1"))
            return file.refuse("begins as a bag of ROS of an unknown format (" + printable(line) +
                               "); formats 1 and 2.0 are known");
        return file.refuse("is a bag of ROS of the old format 1 (" + printable(line) +
                           "); convert it to 2.0: rosbag migrate FILE NEW.bag");
    }
    auto bag = std::make_unique<Bag>(std::move(file));
    bag->read_layout();
    return bag;
}

}  // namespace scipd::sim
