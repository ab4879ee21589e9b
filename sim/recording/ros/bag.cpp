// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/ros/bag.h"

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "sim/recording/compression/compression.h"
#include "sim/recording/file/byte_reader.h"
#include "sim/recording/ros/laser_topics.h"
#include "sim/recording/values/left_out.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

constexpr std::string_view bag_magic = "#ROSBAG V2.0\n";

enum class Operation : std::uint8_t { message = 2, chunk = 5, connection = 7 };  // and others

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
HostTime bag_time(const BagFields& fields) {
    const auto both = fields.number<std::uint64_t>("time");
    return host_time_at(both & 0xFFFFFFFF, both >> 32);
}

class Bag final : public Recording {
  public:
    explicit Bag(InputFile file) : Recording("bag"), file_(std::move(file)) {}

  private:
    Next do_next() override {
        for (;;) {
            while (!records_.at_end()) {
                auto item = take_record();
                if (!item || *item) return item;
            }
            const auto more = read_record();
            if (!more) return tl::unexpected(more.error());
            if (!*more) break;
        }
        if (!left_out_.empty()) warn(file_.name() + ": " + left_out_.sentence());
        return std::nullopt;
    }

    /// A record of a chunk, or of a file without chunks.
    Next take_record() {
        const BagFields fields(records_.text());
        const std::string_view data = records_.text();
        if (records_.too_short()) {
            records_ = ByteReader({});
            return file_.refuse_byte(chunk_begin_, "the chunk that begins here is damaged");
        }
        if (fields.operation() == Operation::connection) add_connection(fields, data);
        const auto connection = fields.number<std::uint32_t>("conn");
        if (fields.operation() != Operation::message || !topics_.has(connection))
            return std::nullopt;
        auto item = topics_.item(connection, bag_time(fields), data);
        if (!item) return file_.refuse_byte(chunk_begin_, item.error().why);
        return std::move(*item);
    }

    void add_connection(const BagFields& fields, std::string_view data) {
        const std::string topic = fields.text("topic");
        const std::string type = BagFields(data).text("type");
        if (!topics_.add(fields.number<std::uint32_t>("conn"), {topic, type, RosEncoding::ros1}))
            left_out_.add(topic, type);
    }

    /// Whether there was a record; what it has to say is in records_ then.
    Expected<bool> read_record();
    Expected<> unpack(const BagFields& fields, const std::string& data);

    InputFile file_;
    std::uint64_t next_byte_ = bag_magic.size();
    std::uint64_t chunk_begin_ = 0;  ///< where the record in block_ begins in the file
    std::string block_;
    ByteReader records_{{}};  ///< the rest of block_
    LeftOut left_out_;
    LaserTopics topics_{{[this](RecordedStream one) { return add_stream(std::move(one)); },
                         [this](std::size_t index) -> RecordedStream& { return stream(index); }}};
};

Expected<bool> Bag::read_record() {
    constexpr std::size_t longest_header = std::size_t{1} << 20;
    chunk_begin_ = next_byte_;
    if (next_byte_ >= file_.size()) return false;
    const auto lost = [&]() -> Expected<bool> {
        warn(file_.name() + " ends within the record at byte " + std::to_string(chunk_begin_) +
             ", which is lost: its recorder was stopped there");
        next_byte_ = file_.size();
        return false;
    };
    const auto beginning = file_.read(next_byte_, sizeof(std::uint32_t));
    if (!beginning) return tl::unexpected(beginning.error());
    const auto header_size = ByteReader(*beginning).number<std::uint32_t>();
    if (beginning->size() < sizeof header_size) return lost();
    if (header_size > longest_header) return file_.refuse_byte(next_byte_, "no record begins here");
    // The header, and the size of the data.
    const auto header = file_.read(next_byte_ + 4, header_size + sizeof(std::uint32_t));
    if (!header) return tl::unexpected(header.error());
    if (header->size() < header_size + sizeof(std::uint32_t)) return lost();
    const BagFields fields(std::string_view(*header).substr(0, header_size));
    const auto size =
        ByteReader(std::string_view(*header).substr(header_size)).number<std::uint32_t>();
    const std::uint64_t data_begin = next_byte_ + 8 + header_size;
    next_byte_ = data_begin + size;
    if (next_byte_ > file_.size()) return lost();
    const Operation operation = fields.operation();
    if (operation != Operation::chunk && operation != Operation::connection &&
        operation != Operation::message)
        return true;
    if (size > largest_block) return file_.refuse_byte(chunk_begin_, "the record is too large");
    const auto data = file_.read(data_begin, size);
    if (!data) return tl::unexpected(data.error());
    if (data->size() < size) return lost();
    if (operation != Operation::chunk) {
        block_ = *beginning + *header + *data;
    } else if (const auto unpacked = unpack(fields, *data); !unpacked) {
        return file_.refuse_byte(chunk_begin_, "the chunk " + unpacked.error().why);
    }
    records_ = ByteReader(block_);
    return true;
}

Expected<> Bag::unpack(const BagFields& fields, const std::string& data) {
    const std::string compression = fields.text("compression");
    Expected<std::string> bytes = data;
    if (compression == "bz2") {
        bytes = unpack_bzip2(data);
    } else if (compression == "lz4") {
        bytes = unpack_lz4(data);
    } else if (compression != "none") {
        return refuse("is packed by " + quote(compression) + ", which is unknown");
    }
    if (!bytes) return tl::unexpected(bytes.error());
    block_ = std::move(*bytes);
    return {};
}

}  // namespace

Expected<std::unique_ptr<Recording>> open_bag(InputFile file) {
    const auto beginning = file.read(0, bag_magic.size());
    if (!beginning) return tl::unexpected(beginning.error());
    if (*beginning == bag_magic) return std::make_unique<Bag>(std::move(file));
    return file.refuse("is a bag of another format than 2.0; rosbag migrate makes one of it");
}

}  // namespace scipd::sim
