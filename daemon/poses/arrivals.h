// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Counts what comes from a source of poses, how often and how late, and logs whether that is often
// and early enough. One thread.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "daemon/poses/source_report.h"
#include "sim/time.h"
#include "sim/world/pose_track.h"

namespace scipd::daemon {

/// Delays of poses that a robot bears on the wall clock.
struct PoseNeeds {
    sim::PosePolicy policy;
    sim::Time wait{};                                  ///< of scans for poses
    sim::Time sweep = std::chrono::milliseconds(100);  ///< the shortest of its scanners
};

class Arrivals {
  public:
    using Moment = std::chrono::steady_clock::time_point;

    /// One came, this much later than its moment; nothing: it said no time, or time waits for it.
    void note(Moment now, std::optional<sim::Time> lateness);
    void note_refused() { ++refused_; }

    /// To be called after note(): the log says the rate once, and warns where poses come too seldom
    /// or too late for the needs.
    void log(Moment now, const std::string& robot, const PoseNeeds& needs);
    /// Message for the log, and its level.
    struct News {
        bool warns;
        std::string text;
    };
    [[nodiscard]] std::optional<News> news(Moment now, const PoseNeeds& needs);

    /// Adds what it knows.
    void tell(Moment now, SourceReport& report) const;

  private:
    struct Second {
        std::int64_t number = -1;  ///< since the epoch of the clock
        std::uint64_t came = 0;
        std::uint64_t stamped = 0;
        double late_ms = 0.0;  ///< of all together
        double most_late_ms = 0.0;
    };

    std::uint64_t messages_ = 0;
    std::uint64_t refused_ = 0;
    std::optional<Moment> first_;
    Moment last_{};
    std::optional<Moment> looked_;  ///< for news
    std::uint64_t messages_then_ = 0;
    bool told_ = false;
    bool warned_ = false;
    std::array<Second, 6> seconds_;  ///< the last ones, by their number: the present and five
};

}  // namespace scipd::daemon
