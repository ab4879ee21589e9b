// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "sim/recording/compression/compression.h"
#include "sim/recording/ros/bags.h"
#include "sim/recording/ros/database.h"
#include "sim/recording/ros/laser_topics.h"

namespace scipd::sim {
namespace {

constexpr std::string_view zstd_magic{"\x28\xB5\x2F\xFD", 4};

class Db3 final : public Recording {
  public:
    Db3(InputFile file, Database database)
        : Recording("db3"), file_(std::move(file)), database_(std::move(database)) {}

    /// Before the first message.
    Expected<> read_topics() {
        for (const char* const table : {"topics", "messages"}) {
            const auto checked = database_.check_table(table);
            if (!checked) return file_.refuse("is no bag of rosbag2: " + checked.error().why);
        }
        Rows topics = database_.ask("SELECT id, name, type, serialization_format FROM topics");
        for (;;) {
            const auto row = topics.next();
            if (!row) return file_.refuse("is no bag of rosbag2: " + row.error().why);
            if (!*row) break;
            const auto id = static_cast<std::uint32_t>(topics.number(0));
            const std::string name(topics.bytes(1));
            const std::string type(topics.bytes(2));
            if (topics.bytes(3) != "cdr" || !topics_.add(id, {name, type, RosEncoding::cdr}))
                leave_out(file_.name(), name, type);
        }
        // Where there is no index of the times, the library sorts the rows, but without the data.
        messages_ = database_.ask(
            "SELECT rowid, topic_id, timestamp FROM messages WHERE timestamp >= ? "
            "ORDER BY timestamp, rowid");
        messages_->bind(std::numeric_limits<std::int64_t>::min());
        data_ = database_.ask("SELECT data FROM messages WHERE rowid = ?");
        return {};
    }

    void skip_ahead(std::chrono::nanoseconds since_first) override {
        const auto log_ns = begin_ns_.value_or(0) + since_first.count();
        if (begin_ns_ && log_ns > log_ns_) messages_->bind(log_ns);
    }

  private:
    Next do_next() override {
        for (;;) {
            const auto row = messages_->next();
            if (!row)
                lose(file_.refuse("the rest, behind message " + std::to_string(message_) +
                                  ", cannot be read: " + row.error().why));
            if (!row || !*row) return std::nullopt;
            message_ = messages_->number(0);
            // Of a sane clock, so that sums fit.
            log_ns_ = std::clamp<std::int64_t>(messages_->number(2), 0, std::int64_t{1} << 62);
            if (!begin_ns_) begin_ns_ = log_ns_;
            const auto topic = static_cast<std::uint32_t>(messages_->number(1));
            if (!topics_.has(topic)) continue;
            auto item = item_of(topic);
            if (item) return std::move(*item);
            lose(file_.refuse("message " + std::to_string(message_) + ": " + item.error().why));
        }
    }

    Expected<RecordedItem> item_of(std::uint32_t topic) {
        data_->bind(message_);
        const auto row = data_->next();
        if (!row) return tl::unexpected(row.error());
        const HostTime logged{std::chrono::nanoseconds(log_ns_)};
        const std::string_view data = *row ? data_->bytes(0) : std::string_view{};
        if (!data.starts_with(zstd_magic)) return topics_.item(topic, logged, data);
        return unpack_zstd(data).and_then(
            [&](const std::string& bytes) { return topics_.item(topic, logged, bytes); });
    }

    InputFile file_;
    Database database_;
    std::optional<Rows> messages_;
    std::optional<Rows> data_;
    std::int64_t message_ = 0;              ///< the last one that was met
    std::int64_t log_ns_ = 0;               ///< its log time
    std::optional<std::int64_t> begin_ns_;  ///< log time of the first message
    LaserTopics topics_{{[this](RecordedStream one) { return add_stream(std::move(one)); },
                         [this](std::size_t index) -> RecordedStream& { return stream(index); }}};
};

}  // namespace

Expected<std::unique_ptr<Recording>> open_db3(InputFile file) {
    auto database = Database::open(file);
    if (!database) return tl::unexpected(database.error());
    auto recording = std::make_unique<Db3>(std::move(file), std::move(*database));
    if (const auto read = recording->read_topics(); !read) return tl::unexpected(read.error());
    return recording;
}

}  // namespace scipd::sim
