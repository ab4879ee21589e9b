// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/ros/laser_topics.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "sim/text/quote.h"

namespace scipd::sim {

bool LaserTopics::add(std::uint32_t id, const RosTopic& topic) {
    const auto type = laser_type(topic.type);
    if (!type) return false;
    if (topics_.contains(id)) return true;
    // Several publishers of one topic are several connections of a bag.
    const auto [found, is_new] = streams_by_name_.try_emplace(topic.name, 0);
    if (is_new) found->second = streams_.add({.name = topic.name, .type = topic.type});
    topics_[id] = {topic.name, found->second, *type, topic.encoding};
    return true;
}

Expected<RecordedItem> LaserTopics::item(std::uint32_t id, HostTime logged,
                                         std::string_view bytes) {
    Topic& topic = topics_.at(id);
    auto message = parse_laser(bytes, topic.type, topic.encoding);
    if (!message) return refuse(quote(topic.name) + ": " + message.error().why);
    ScannerIdentity& identity = streams_.at(topic.stream).identity;
    if (!identity.max_range_m && std::isfinite(message->max_range_m)) {
        identity.min_range_m = message->min_range_m;
        identity.max_range_m = message->max_range_m;
    }
    // Within these, sums and differences of two times fit.
    constexpr HostTime latest{std::chrono::nanoseconds(std::int64_t{1} << 62)};
    const HostTime sane = std::clamp(logged, HostTime{}, latest);
    std::optional<HostTime>& time = message->scan.host_time;
    const bool stamped = time.has_value();
    if (stamped) topic.stamp_after_log = *time - sane;
    if (!stamped) time = sane + topic.stamp_after_log;
    return RecordedItem{topic.stream, std::move(message->scan), logged, stamped};
}

}  // namespace scipd::sim
