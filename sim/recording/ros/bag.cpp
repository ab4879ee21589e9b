// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/ros/bag.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "sim/recording/compression/compression.h"
#include "sim/recording/file/byte_reader.h"
#include "sim/recording/file/byte_writer.h"
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

bool is_wanted(Operation operation) {
    return operation == Operation::chunk || operation == Operation::connection ||
           operation == Operation::message;
}

/// A record as it stands in the file.
struct FileRecord {
    std::string header;
    std::uint64_t data_begin = 0;
    std::uint32_t data_size = 0;
};

Expected<std::string> unpacked(const std::string& compression, std::string data) {
    if (compression == "none") return data;
    if (compression == "bz2") return unpack_bzip2(data);
    if (compression == "lz4") return unpack_lz4(data);
    return refuse("is packed by " + quote(compression) + ", which is unknown");
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
            return file_.refuse_byte(record_begin_, "the chunk that begins here is damaged");
        }
        if (fields.operation() == Operation::connection) add_connection(fields, data);
        const auto connection = fields.number<std::uint32_t>("conn");
        if (fields.operation() != Operation::message || !topics_.has(connection))
            return std::nullopt;
        auto item = topics_.item(connection, bag_time(fields), data);
        if (!item) return file_.refuse_byte(record_begin_, item.error().why);
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
    /// Nothing where the file ends within it.
    Expected<std::optional<FileRecord>> read_head();
    Expected<> keep(const FileRecord& record, std::string data);
    bool lose_rest();

    InputFile file_;
    std::uint64_t next_byte_ = bag_magic.size();
    std::uint64_t record_begin_ = 0;  ///< of the one in block_, in the file
    std::string block_;
    ByteReader records_{{}};  ///< the rest of block_
    LeftOut left_out_;
    LaserTopics topics_{{[this](RecordedStream one) { return add_stream(std::move(one)); },
                         [this](std::size_t index) -> RecordedStream& { return stream(index); }}};
};

Expected<bool> Bag::read_record() {
    record_begin_ = next_byte_;
    if (next_byte_ >= file_.size()) return false;
    const auto record = read_head();
    if (!record) return tl::unexpected(record.error());
    if (!*record || (*record)->data_begin + (*record)->data_size > file_.size()) return lose_rest();
    next_byte_ = (*record)->data_begin + (*record)->data_size;
    if (!is_wanted(BagFields((*record)->header).operation())) return true;
    if ((*record)->data_size > largest_block)
        return file_.refuse_byte(record_begin_, "the record is larger than any of a bag");
    auto data = file_.read((*record)->data_begin, (*record)->data_size);
    if (!data) return tl::unexpected(data.error());
    if (const auto kept = keep(**record, std::move(*data)); !kept)
        return file_.refuse_byte(record_begin_, "the chunk " + kept.error().why);
    return true;
}

Expected<std::optional<FileRecord>> Bag::read_head() {
    constexpr std::size_t longest_header = std::size_t{1} << 20;
    constexpr std::size_t length = sizeof(std::uint32_t);
    const auto beginning = file_.read(record_begin_, length);
    if (!beginning) return tl::unexpected(beginning.error());
    if (beginning->size() < length) return std::nullopt;
    const auto header_size = ByteReader(*beginning).number<std::uint32_t>();
    if (header_size > longest_header)
        return file_.refuse_byte(record_begin_, "no record begins here");
    const auto rest = file_.read(record_begin_ + length, header_size + length);
    if (!rest) return tl::unexpected(rest.error());
    if (rest->size() < header_size + length) return std::nullopt;
    ByteReader reader(*rest);
    FileRecord record;
    record.header = reader.take(header_size);
    record.data_size = reader.number<std::uint32_t>();
    record.data_begin = record_begin_ + header_size + 2 * length;
    return record;
}

/// Puts the records of a chunk, or this one, where they are taken from.
Expected<> Bag::keep(const FileRecord& record, std::string data) {
    const BagFields fields(record.header);
    if (fields.operation() != Operation::chunk) {
        block_ = ByteWriter{}.text(record.header).text(data).bytes();
    } else {
        auto bytes = unpacked(fields.text("compression"), std::move(data));
        if (!bytes) return tl::unexpected(bytes.error());
        block_ = std::move(*bytes);
    }
    records_ = ByteReader(block_);
    return {};
}

bool Bag::lose_rest() {
    warn(file_.name() + " ends within the record at byte " + std::to_string(record_begin_) +
         ", which is lost: its recorder was stopped there");
    next_byte_ = file_.size();
    return false;
}

}  // namespace

Expected<std::unique_ptr<Recording>> open_bag(InputFile file) {
    const auto beginning = file.read(0, bag_magic.size());
    if (!beginning) return tl::unexpected(beginning.error());
    if (*beginning == bag_magic) return std::make_unique<Bag>(std::move(file));
    return file.refuse("is a bag of another format than 2.0; rosbag migrate makes one of it");
}

}  // namespace scipd::sim
