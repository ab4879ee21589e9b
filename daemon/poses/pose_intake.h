// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Every live pose goes through here, whichever way it came: a line is understood, stamped in world
// time, handed to the world, and counted. A damaged line is refused with a reason, and the last
// good pose stays. Lives on the I/O thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "daemon/limits/limits.h"
#include "daemon/limits/rate.h"
#include "daemon/limits/throttle.h"
#include "daemon/poses/lockstep.h"
#include "daemon/poses/stamp_leap.h"
#include "daemon/world/world.h"
#include "sim/expected.h"
#include "sim/loaders/poses/pose_line.h"
#include "sim/time.h"

namespace scipd::daemon {

/// World time for the stamps of one sender, whose clock may begin anywhere: its first stamp is the
/// moment of its arrival, and the spacing of the others is kept. If the sender starts over or its
/// clock leaps, this begins anew.
///
/// A clock that runs at another speed is followed. Once all stamps of half a second came more than
/// 100 ms late, they are moved until the least late of the latest ones is 100 ms late; early stamps
/// are moved in the same way. Shorter deviations are packets that were held up, or poses sent
/// ahead, and move nothing. World time always grows with the stamps, at least a tenth as fast.
class SenderClock {
  public:
    [[nodiscard]] sim::Time world_time(std::optional<sim::Time> stamp, sim::Time arrival);

    /// How much later the latest stamp came than its moment in world time. Nothing: none came.
    [[nodiscard]] std::optional<sim::Time> last_lateness() const {
        if (!world_minus_sender_) return std::nullopt;
        return last_arrival_ - last_stamp_ - *world_minus_sender_;
    }

    /// In lockstep, where all senders share the time: the leaps of this one away from it.
    [[nodiscard]] StampLeap& leap() { return leap_; }

  private:
    enum class Side { in_time, late, early };

    /// Arrivals in a row that are all late, or all early, cut into portions of time: packets that
    /// were held up come together, and only the last of them tells how late the sender is.
    struct Run {
        Side side = Side::in_time;
        sim::Time since{};
        sim::Time portion_since{};
        std::size_t portions = 0;
        /// Arrival minus stamp of the least late (or early) arrival of each portion, in no order.
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
    explicit PoseIntake(World& world, Lockstep* lockstep = nullptr,
                        SharedLimits limits = std::make_shared<Limits>())
        : world_(world), lockstep_(lockstep), limits_(std::move(limits)) {}

    /// To be asked before each pose of this sender. A pose that is one too many is counted and is
    /// to be told. In lockstep none is: time waits for poses, and two runs have to be the same.
    [[nodiscard]] sim::Expected<> admit(Rate& sender);

    /// One line of a stream. A line without a name means `robot`, or the only robot where `robot`
    /// is empty. A refused line is counted and changes nothing.
    [[nodiscard]] sim::Expected<> take_line(std::string_view line, std::string_view robot,
                                            SenderClock& sender, sim::Time arrival);
    /// Takes a line that has been understood already.
    [[nodiscard]] sim::Expected<> take(const sim::PoseLine& line, std::string_view robot,
                                       SenderClock& sender, sim::Time arrival);
    /// Takes it at a world time. A line that says no time itself holds from then on.
    [[nodiscard]] sim::Expected<> take_at(sim::Time time, const sim::PoseLine& line,
                                          std::string_view robot);
    /// World time of a step that a leader says, with whatever poses; in lockstep. A stamp that
    /// leaps is refused until others follow it, as that of a pose is.
    [[nodiscard]] sim::Expected<sim::Time> take_step(sim::Time stamp, SenderClock& leader);

    /// Called after each pose that is taken, with its world time; a line without a name means
    /// `robot`.
    using Taken =
        std::function<void(const sim::PoseLine& line, std::string_view robot, sim::Time time)>;
    void on_taken(Taken callback) { on_taken_ = std::move(callback); }

    [[nodiscard]] const World& world() const { return world_; }
    [[nodiscard]] std::uint64_t accepted() const { return accepted_; }
    [[nodiscard]] std::uint64_t refused() const { return refused_; }
    [[nodiscard]] const std::optional<std::string>& last_refusal() const { return last_refusal_; }

  private:
    [[nodiscard]] sim::Expected<> take_stamped(sim::Time stamp, const sim::PoseLine& line,
                                               std::string_view robot, SenderClock& sender);
    [[nodiscard]] sim::Expected<> take_leaping(sim::Time stamp, const sim::PoseLine& line,
                                               std::string_view robot, SenderClock& sender);
    [[nodiscard]] sim::Expected<sim::Time> time_behind_leap(sim::Time stamp, SenderClock& sender);
    void leap(SenderClock& sender);
    [[nodiscard]] Placed place(const sim::PoseLine& line, std::string_view robot, sim::Time time);
    sim::Expected<> count(sim::Expected<> taken);

    World& world_;
    Lockstep* lockstep_;
    SharedLimits limits_;
    std::uint64_t accepted_ = 0;
    std::uint64_t refused_ = 0;
    std::optional<std::string> last_refusal_;
    Throttle leaps_told_;
    Taken on_taken_;
};

}  // namespace scipd::daemon
