// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The topics of a recording of ROS that hold scans, and their messages as items. Of one owner; any
// thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "sim/recording/ros/laser_message.h"
#include "sim/recording/values/recording.h"

namespace scipd::sim {

/// A topic as a file names it.
struct RosTopic {
    std::string name;
    std::string type;
    RosEncoding encoding = RosEncoding::ros1;
};

class LaserTopics {
  public:
    /// Recording::add_stream() and stream() of the recording that these are of.
    struct Streams {
        std::function<std::size_t(RecordedStream)> add;
        std::function<RecordedStream&(std::size_t)> at;
    };
    explicit LaserTopics(Streams streams) : streams_(std::move(streams)) {}

    /// Whether the topic holds scans. One that is added again stays.
    bool add(std::uint32_t id, const RosTopic& topic);
    [[nodiscard]] bool has(std::uint32_t id) const { return topics_.contains(id); }

    /// A message of a topic that has(). Where the stamp of its header is 0, the log time counts, on
    /// the clock of the topic's other stamps.
    [[nodiscard]] Expected<RecordedItem> item(std::uint32_t id, HostTime logged,
                                              std::string_view bytes);

  private:
    struct Topic {
        std::string name;
        std::size_t stream;
        LaserType type;
        RosEncoding encoding;
        std::chrono::nanoseconds stamp_after_log{};  ///< of the last message with a stamp
    };

    Streams streams_;
    std::map<std::uint32_t, Topic> topics_;
    std::map<std::string, std::size_t> streams_by_name_;
};

}  // namespace scipd::sim
