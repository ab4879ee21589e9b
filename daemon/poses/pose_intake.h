// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where every live pose goes through, whichever way it came: lines are understood, stamped in world
// time, handed to the world, and counted. What is damaged is refused with a reason; the last good
// pose stays. Lives on the I/O thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "daemon/poses/lockstep.h"
#include "daemon/poses/stamp_leap.h"
#include "daemon/poses/throttle.h"
#include "daemon/world/world.h"
#include "sim/loaders/poses/trajectory.h"
#include "sim/time.h"

namespace scipd::daemon {

/// World time for the stamps of one sender, whose clock may begin anywhere: its first stamp is the
/// moment of its arrival, and the spacing of the others is kept. A sender that starts over, or
/// whose clock leaps, is taken up anew.
///
/// One whose clock runs at another speed is followed: where all stamps of half a second came more
/// than 100 ms late, they are moved until the least late one of the latest is 100 ms late; the same
/// for early ones. What is shorter is a packet held up, or a drive sent ahead, and moves nothing.
/// World time goes on growing with the stamps, a tenth as fast as they do at least.
class SenderClock {
  public:
    [[nodiscard]] sim::Time world_time(std::optional<sim::Time> stamp, sim::Time arrival);

    /// In lockstep, where all senders share the time: what this one says away from it.
    [[nodiscard]] StampLeap& leap() { return leap_; }

  private:
    enum class Side { in_time, late, early };

    /// Arrivals in a row that are all late, or all early, in portions: packets that were held up
    /// come together, and only the last of them says how late the sender is.
    struct Run {
        Side side = Side::in_time;
        sim::Time since{};
        sim::Time portion_since{};
        std::size_t portions = 0;
        /// Arrival minus stamp of the least late (or early) one of each, in no order.
        std::array<sim::Time, 3> least{};
    };

    void take_up(sim::Time stamp, sim::Time arrival);
    void follow(sim::Time stamp, sim::Time arrival);
    void extend_run(sim::Time arrival_minus_stamp, sim::Time arrival);

    std::optional<sim::Time> world_minus_sender_;
    sim::Time last_stamp_{};
    sim::Time last_arrival_{};
    sim::Time newest_stamp_{};
    Run run_;
    StampLeap leap_;
};

class PoseIntake {
  public:
    /// `world` must outlive this, and so must `lockstep`; null: on the wall clock.
    explicit PoseIntake(World& world, Lockstep* lockstep = nullptr)
        : world_(world), lockstep_(lockstep) {}

    /// One line of a stream. `robot` is whom a line without a name means; empty: the only one there
    /// is. Returns why the line was refused.
    std::optional<std::string> take_line(std::string_view line, std::string_view robot,
                                         SenderClock& sender, sim::Time arrival);
    /// The same, understood already.
    std::optional<std::string> take(const sim::PoseLine& line, std::string_view robot,
                                    SenderClock& sender, sim::Time arrival);
    /// The same in world time; a line without a time of its own holds from then on.
    std::optional<std::string> take_at(sim::Time time, const sim::PoseLine& line,
                                       std::string_view robot);

    [[nodiscard]] std::uint64_t accepted() const { return accepted_; }
    [[nodiscard]] std::uint64_t refused() const { return refused_; }
    [[nodiscard]] const std::optional<std::string>& last_refusal() const { return last_refusal_; }

  private:
    std::optional<std::string> take_stamped(sim::Time stamp, const sim::PoseLine& line,
                                            std::string_view robot, SenderClock& sender);
    std::optional<std::string> take_leaping(sim::Time stamp, const sim::PoseLine& line,
                                            std::string_view robot, SenderClock& sender);
    std::optional<std::string> place(const sim::PoseLine& line, std::string_view robot,
                                     sim::Time time);
    std::optional<std::string> count(std::optional<std::string> refusal);

    World& world_;
    Lockstep* lockstep_;
    std::uint64_t accepted_ = 0;
    std::uint64_t refused_ = 0;
    std::optional<std::string> last_refusal_;
    Throttle leaps_told_;
};

}  // namespace scipd::daemon
