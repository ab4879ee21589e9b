// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/ros/db3.h"

#include <optional>
#include <string>
#include <utility>

#include "sim/recording/compression/compression.h"
#include "sim/recording/ros/database.h"
#include "sim/recording/ros/laser_topics.h"
#include "sim/recording/values/left_out.h"

namespace scipd::sim {
namespace {

constexpr std::string_view zstd_magic{"\x28\xB5\x2F\xFD", 4};

class Db3 final : public Recording {
  public:
    Db3(InputFile file, Database database)
        : Recording("db3"), file_(std::move(file)), database_(std::move(database)) {}

    /// Before the first message.
    Expected<> read_topics() {
        Rows topics = database_.ask("SELECT id, name, type, serialization_format FROM topics");
        for (;;) {
            const auto row = topics.next();
            if (!row) return file_.refuse("is no bag of rosbag2: " + row.error().why);
            if (!*row) break;
            const auto id = static_cast<std::uint32_t>(topics.number(0));
            const std::string name(topics.bytes(1));
            const std::string type(topics.bytes(2));
            if (topics.bytes(3) != "cdr" || !topics_.add(id, {name, type, RosEncoding::cdr}))
                left_out_.add(name, type);
        }
        if (!left_out_.empty()) warn(file_.name() + ": " + left_out_.sentence());
        messages_ = database_.ask("SELECT id, topic_id, timestamp, data FROM messages ORDER BY id");
        return {};
    }

  private:
    Next do_next() override {
        for (;;) {
            const auto row = messages_->next();
            if (!row)
                return file_.refuse("cannot be read behind message " + std::to_string(message_) +
                                    ": " + row.error().why);
            if (!*row) return std::nullopt;
            message_ = messages_->number(0);
            const auto topic = static_cast<std::uint32_t>(messages_->number(1));
            if (!topics_.has(topic)) continue;
            auto item = item_of(topic);
            if (!item)
                return file_.refuse("message " + std::to_string(message_) + ": " +
                                    item.error().why);
            return std::move(*item);
        }
    }

    Expected<RecordedItem> item_of(std::uint32_t topic) {
        const HostTime received{std::chrono::nanoseconds(messages_->number(2))};
        const std::string_view data = messages_->bytes(3);
        if (!data.starts_with(zstd_magic)) return topics_.item(topic, received, data);
        return unpack_zstd(data).and_then(
            [&](const std::string& bytes) { return topics_.item(topic, received, bytes); });
    }

    InputFile file_;
    Database database_;
    std::optional<Rows> messages_;
    std::int64_t message_ = 0;  ///< the last one that was met
    LeftOut left_out_;
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
