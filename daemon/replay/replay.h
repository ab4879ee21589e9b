// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The scan of a recording that a scanner shows with each turn of its mirror. A log has one time
// line, which all scanners that play it share: a scan is shown by the turn that begins when it was
// recorded, and turns are made as long as that takes. A replay lives with its scanner.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "daemon/config/replay_config.h"
#include "daemon/replay/tape.h"
#include "sim/time.h"

namespace scipd::daemon {

/// The time line of a log, from the first scan of those that play it. Any thread.
class LogLine {
  public:
    /// `recorded`: when that first scan was, since 1970. `duration`: to the end of the last one.
    LogLine(std::optional<sim::Time> recorded, sim::Time duration)
        : recorded_(recorded), duration_(duration) {}

    [[nodiscard]] std::optional<sim::Time> recorded() const { return recorded_; }
    [[nodiscard]] sim::Time duration() const { return duration_; }

    /// No effect once it has begun.
    void begin(sim::Time time) {
        sim::Time::rep never = not_begun;
        begun_.compare_exchange_strong(never, time.count());
    }
    /// The time since scipd's start at which it began; nullopt: it waits.
    [[nodiscard]] std::optional<sim::Time> begun() const {
        const sim::Time::rep begun = begun_;
        return begun == not_begun ? std::nullopt : std::optional(sim::Time(begun));
    }

  private:
    static constexpr sim::Time::rep not_begun = sim::Time::min().count();
    std::optional<sim::Time> recorded_;
    sim::Time duration_;
    std::atomic<sim::Time::rep> begun_ = not_begun;
};

/// The scans of one scanner of a log.
struct Track {
    SharedTape tape;   ///< null: there is none
    sim::Time lead{};  ///< from the beginning of the log to its first scan
    sim::Time cut{};   ///< silence before the configured position that is not played
    std::shared_ptr<LogLine> line;
};

/// A log of one scanner.
[[nodiscard]] Track track_of(SharedTape tape);

struct ReplayStatus {
    std::string file;
    std::string state;  ///< "waiting" (for its first client), "playing", "paused" or "over"
    double speed = 1.0;
    std::size_t scan = 0;   ///< that comes next, from 0
    std::size_t scans = 0;  ///< in the recording
    sim::Time at{};         ///< since its first scan
    sim::Time duration{};
};

/// A request to a replay; nullopt: that stays.
struct ReplaySteering {
    std::optional<sim::Time> at;  ///< since the first scan
    std::optional<bool> paused;
    std::optional<std::int64_t> step;  ///< show so many scans more, and pause
    std::optional<double> speed;
};

/// A turn of the mirror.
struct ReplayTurn {
    sim::Time begins{};  ///< since scipd's start
    sim::Time stamp{};   ///< the same as poses have it
};

class Replay {
  public:
    Replay(Track track, const ReplayConfig& config);

    struct Shown {
        std::size_t scan = 0;
        std::uint32_t stamp_ms = 0;  ///< 24 bits
    };
    /// Begins the log for all that play it, unless it has begun.
    void begin(sim::Time time) { track_.line->begin(time); }
    [[nodiscard]] bool begun() const { return due_ || begun_ || track_.line->begun(); }
    /// Returns nullopt if it waits, is paused or over, or no scan begins with this turn.
    [[nodiscard]] std::optional<Shown> at(const ReplayTurn& turn) const;
    /// The duration of this turn.
    [[nodiscard]] sim::Time lasts(const ReplayTurn& turn) const;
    [[nodiscard]] const Tape& tape() const { return *track_.tape; }

    /// Holds from this turn on, and leaves the others of the log. Returns the status when the scans
    /// of a step have been shown.
    ReplayStatus steer(const ReplaySteering& steering, const ReplayTurn& turn);
    [[nodiscard]] ReplayStatus status(const ReplayTurn& turn) const {
        return status_at(log_time(turn));
    }

  private:
    // Time of the log goes on from round to round, and scans are counted through all rounds.

    /// Returns nullopt if it has not begun.
    [[nodiscard]] std::optional<sim::Time> log_time(const ReplayTurn& turn) const;
    /// The first scan that begins there or later.
    [[nodiscard]] std::int64_t next_scan(sim::Time log_time) const;
    [[nodiscard]] sim::Time begin_of(std::int64_t scan) const;
    /// Its index on the tape; nullopt: there are no more.
    [[nodiscard]] std::optional<std::size_t> index_of(std::int64_t scan) const;
    [[nodiscard]] ReplayStatus status_at(std::optional<sim::Time> log_time) const;

    Track track_;
    std::string file_;
    ReplayLoop loop_;
    double speed_;
    sim::Time from_;                     ///< log time at its beginning
    std::optional<sim::Time> due_;       ///< stamp of its beginning
    std::optional<sim::Time> begun_;     ///< beginning of its own; nullopt: that of the log's line
    std::optional<sim::Time> rests_at_;  ///< log time at which it pauses
};

}  // namespace scipd::daemon
