// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which scan of a recording a scanner shows at which turn of its mirror. Turns are counted by the
// scanner; what steers the replay holds from a turn on that is still to come. Or it follows the
// line of stamps: each scan begins when it was recorded, however often the mirror turns between.
// Lives with its scanner.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "daemon/config/replay_config.h"
#include "daemon/replay/tape.h"
#include "sim/time.h"

namespace scipd::daemon {

/// How it stands with a replay.
struct ReplayStatus {
    std::string file;
    std::string state;  ///< "playing", "paused" or "over"
    double speed = 1.0;
    std::size_t scan = 0;   ///< that comes next, from 0
    std::size_t scans = 0;  ///< in the recording
    sim::Time at{};         ///< since its first scan
    sim::Time duration{};
};

/// What somebody wants of a replay; nothing: that stays.
struct ReplaySteering {
    std::optional<sim::Time> at;  ///< since the first scan
    std::optional<bool> paused;
    std::optional<std::int64_t> step;  ///< show so many scans more, and pause
    std::optional<double> speed;
};

/// A turn of the mirror.
struct ReplayTurn {
    std::int64_t number = 0;
    sim::Time begins{};  ///< as people call it
};

class Replay {
  public:
    Replay(SharedTape tape, const ReplayConfig& config);

    struct Shown {
        std::size_t scan = 0;
        std::uint32_t stamp_ms = 0;  ///< 24 bits
    };
    /// Nothing: it is paused, or over, or no scan begins with this turn on the line of stamps.
    [[nodiscard]] std::optional<Shown> at(const ReplayTurn& turn) const;
    /// How long this turn takes.
    [[nodiscard]] sim::Time lasts(const ReplayTurn& turn) const;
    [[nodiscard]] const Tape& tape() const { return *tape_; }

    /// Holds from this turn on, and ends that it follows the line of stamps. Returns the status
    /// when the scans of a step have been shown.
    ReplayStatus steer(const ReplaySteering& steering, const ReplayTurn& turn);
    [[nodiscard]] ReplayStatus status(const ReplayTurn& turn) const;

  private:
    /// Scans since the first one, all rounds counted.
    [[nodiscard]] std::int64_t position(const ReplayTurn& turn) const;
    /// Where the line of stamps is in the recording at that time.
    struct Place {
        std::int64_t round = 0;
        sim::Time at{};  ///< since the first scan of the round; negative: before it begins
    };
    [[nodiscard]] Place place(sim::Time time) const;
    /// The scan at this position; nothing where there is none.
    [[nodiscard]] std::optional<std::size_t> scan_at(std::int64_t position) const;
    /// Counts from this turn on.
    void rebase(const ReplayTurn& turn);

    SharedTape tape_;
    std::string file_;
    ReplayLoop loop_;
    double speed_;
    std::optional<sim::Time> begins_;  ///< on the line of stamps; nothing: it counts turns
    std::int64_t turn_ = 0;            ///< the first that is counted from
    std::int64_t position_ = 0;        ///< at that turn
    bool paused_ = false;
    std::int64_t paused_from_ = 0;  ///< turn
};

}  // namespace scipd::daemon
