// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The messages of ROS that are scans, sensor_msgs/LaserScan and sensor_msgs/MultiEchoLaserScan, as
// ROS 1 writes them and as ROS 2 does (CDR, either end first), and recordings with such messages
// under topics. Of one owner; any thread.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "sim/recording/file/recording_file.h"
#include "sim/recording/values/recording.h"

namespace scipd::sim {

enum class RosEncoding { ros1, cdr };

enum class LaserType { laser_scan, multi_echo_laser_scan };

/// The type with this name of ROS 1 or 2; nullopt for types that are no scans.
[[nodiscard]] std::optional<LaserType> laser_type(std::string_view type_name);

struct LaserMessage {
    RecordedScan scan;  ///< in metres; its host time is the stamp of the header, if that is not 0
    double min_range_m = 0;
    double max_range_m = 0;
    std::size_t lost_intensities = 0;  ///< not as many as ranges, and therefore left out
};

[[nodiscard]] Expected<LaserMessage> parse_laser(std::string_view bytes, LaserType type,
                                                 RosEncoding encoding);

/// A topic as a file names it.
struct RosTopic {
    std::string name;
    std::string type;
    RosEncoding encoding = RosEncoding::ros1;
};

class LaserRecording : public Recording {
  protected:
    LaserRecording(std::string format, InputFile file)
        : Recording(std::move(format)), file_(std::move(file)) {}

    /// One without scans is left out. One that is added again stays.
    void add_topic(std::uint32_t id, const RosTopic& topic);
    [[nodiscard]] bool has_topic(std::uint32_t id) const { return topics_.contains(id); }
    void leave_out(const std::string& name, const std::string& type) {
        Recording::leave_out(file_.name(), name, type);
    }
    /// A message of a topic that is there. Where the stamp of its header is 0, the log time counts,
    /// on the clock of the topic's other stamps.
    [[nodiscard]] Expected<RecordedItem> laser_item(std::uint32_t id, HostTime logged,
                                                    std::string_view bytes);

    InputFile file_;
    /// Bytes that may still be unpacked from the file, some of them twice.
    std::uint64_t unpack_left_ =
        std::max<std::uint64_t>(std::uint64_t{1} << 29, 100 * file_.size());

  private:
    struct Topic {
        std::string name;
        std::size_t stream;
        LaserType type;
        RosEncoding encoding;
        bool lost_intensities = false;
        std::chrono::nanoseconds stamp_after_log{};  ///< of the last message with a stamp
    };

    std::map<std::uint32_t, Topic> topics_;
    std::map<std::string, std::size_t> streams_by_name_;
    bool too_many_ = false;  ///< topics, which the user has been told
};

}  // namespace scipd::sim
