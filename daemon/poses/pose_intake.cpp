// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/poses/pose_intake.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>

#include <spdlog/spdlog.h>

namespace scipd::daemon {
namespace {

// In floating point, since the difference of two stamps may not fit into a Time.
using Seconds = std::chrono::duration<double>;

// Where a stamp goes back by more than this, it is no late packet: the sender was started again.
// Where it goes on by that much more than our clock does, it is damaged, or the sender's clock was
// set.
constexpr Seconds largest_slip = StampLeap::longest_back;

// Poses that come earlier or later by less than this stay exactly where their stamps say.
constexpr sim::Time dead_zone = std::chrono::milliseconds(100);
// Longer than packets are held up together.
constexpr sim::Time patience = std::chrono::milliseconds(500);
// Longer than held-up packets take to come in, and shorter than a sender takes to drift much.
constexpr sim::Time portion = std::chrono::milliseconds(50);

/// Only what a person is told of it.
sim::Expected<> told(const Placed& placed) {
    if (placed) return {};
    return tl::unexpected<sim::Fault>(placed.error());
}

std::string from_to(sim::Time before, sim::Time now) {
    std::array<char, 80> text{};
    std::snprintf(text.data(), text.size(), " from %.3f s to %.3f s", Seconds(before).count(),
                  Seconds(now).count());
    return text.data();
}

}  // namespace

sim::Time SenderClock::world_time(std::optional<sim::Time> stamp, sim::Time arrival) {
    if (!stamp) return arrival;
    const Seconds passed = Seconds(*stamp) - Seconds(last_stamp_);
    const bool leapt =
        passed < -largest_slip || passed - Seconds(arrival - last_arrival_) > largest_slip;
    if (!world_minus_sender_ || leapt) take_up(*stamp, arrival);
    last_stamp_ = *stamp;
    last_arrival_ = arrival;
    // A packet that was overtaken says nothing of the clock; equal stamps are one moment.
    if (*stamp > newest_stamp_) follow(*stamp, arrival);
    return *stamp + *world_minus_sender_;
}

void SenderClock::take_up(sim::Time stamp, sim::Time arrival) {
    world_minus_sender_ = arrival - stamp;
    newest_stamp_ = stamp;
    run_ = {};
}

void SenderClock::follow(sim::Time stamp, sim::Time arrival) {
    const sim::Time step = stamp - newest_stamp_;
    newest_stamp_ = stamp;
    extend_run(arrival - stamp, arrival);
    if (run_.portions < run_.least.size() || arrival - run_.since < patience) return;
    const auto [least, most] = std::minmax_element(run_.least.begin(), run_.least.end());
    sim::Time& offset = *world_minus_sender_;
    if (run_.side == Side::late) offset = std::max(offset, *least - dead_zone);
    if (run_.side == Side::early)
        offset = std::max(std::min(offset, *most + dead_zone), offset - step / 10 * 9);
}

void SenderClock::extend_run(sim::Time arrival_minus_stamp, sim::Time arrival) {
    const sim::Time lateness = arrival_minus_stamp - *world_minus_sender_;
    const Side side = lateness > dead_zone    ? Side::late
                      : lateness < -dead_zone ? Side::early
                                              : Side::in_time;
    if (side != run_.side) run_ = {.side = side, .since = arrival};
    const bool first = run_.portions == 0 || arrival - run_.portion_since >= portion;
    if (first) {
        run_.portion_since = arrival;
        ++run_.portions;
    }
    sim::Time& least = run_.least[run_.portions % run_.least.size()];
    if (first || (side == Side::late) == (arrival_minus_stamp < least)) least = arrival_minus_stamp;
}

sim::Expected<> PoseIntake::admit(Rate& sender) {
    if (lockstep_ != nullptr || sender.admit((*limits_)[Limit::poses_per_s])) return {};
    return count(sim::refuse(limits_->refuse(Limit::poses_per_s, "poses")));
}

sim::Expected<> PoseIntake::take_line(std::string_view line, std::string_view robot,
                                      SenderClock& sender, sim::Time arrival) {
    const auto said = sim::parse_pose_line(line);
    if (!said) return count(tl::unexpected(said.error()));
    return take(*said, robot, sender, arrival);
}

// In lockstep the senders' stamps are the time itself.
sim::Expected<> PoseIntake::take(const sim::PoseLine& line, std::string_view robot,
                                 SenderClock& sender, sim::Time arrival) {
    if (lockstep_ == nullptr) return take_at(sender.world_time(line.time, arrival), line, robot);
    if (!line.time) return count(sim::refuse("t", "t is missing: time is that of the poses"));
    return count(take_stamped(*line.time, line, robot, sender));
}

sim::Expected<> PoseIntake::take_stamped(sim::Time stamp, const sim::PoseLine& line,
                                         std::string_view robot, SenderClock& sender) {
    const auto time = lockstep_->world_time(stamp);
    const sim::Time before = lockstep_->come_to(&sender);
    if (!time || *time - before > StampLeap::longest_ahead)
        return take_leaping(stamp, line, robot, sender);
    const Placed placed = place(line, robot, *time);
    const bool leaps_back = before - *time > StampLeap::longest_back;
    if (!placed && placed.error().reason == NotPlaced::Reason::not_later && leaps_back)
        return take_leaping(stamp, line, robot, sender);
    if (!placed) return told(placed);
    if (*time > before) sender.leap().forget();
    lockstep_->begin_with(stamp);
    lockstep_->come_to(&sender, *time, world_.has_one_mover());
    return {};
}

// World time goes on from the last pose that was taken. The sender's stamps go on from the first
// one behind the leap.
sim::Expected<> PoseIntake::take_leaping(sim::Time stamp, const sim::PoseLine& line,
                                         std::string_view robot, SenderClock& sender) {
    const auto time = time_behind_leap(stamp, sender);
    if (!time) return tl::unexpected(time.error());
    if (const Placed placed = place(line, robot, *time); !placed) return told(placed);
    leap(sender);
    lockstep_->come_to(&sender, *time, world_.has_one_mover());
    return {};
}

sim::Expected<sim::Time> PoseIntake::time_behind_leap(sim::Time stamp, SenderClock& sender) {
    const sim::Time before = lockstep_->clock().origin() + lockstep_->come_to(&sender);
    const std::string leaps = "t: leaps" + from_to(before, stamp);
    if (!lockstep_->leads(&sender))
        return sim::refuse("t", leaps + "; others lead time, and stamps must keep to theirs");
    if (!sender.leap().take(stamp))
        return sim::refuse("t", leaps + "; a second of stamps that follow it makes it the time");
    const sim::Time first = sender.leap().first();
    const auto time = lockstep_->time_anew(&sender, first, stamp);
    if (!time) return sim::refuse("t", leaps + ", too far for one run");
    return *time;
}

void PoseIntake::leap(SenderClock& sender) {
    const sim::Time before = lockstep_->clock().origin() + lockstep_->come_to(&sender);
    const sim::Time first = sender.leap().first();
    if (const auto others = leaps_told_.admit(std::chrono::steady_clock::now())) {
        spdlog::warn("the stamps of poses jumped{}: time continues from there{}",
                     from_to(before, first), *others);
    }
    sender.leap().forget();
    lockstep_->begin_anew_with(&sender, first);
}

sim::Expected<sim::Time> PoseIntake::take_step(sim::Time stamp, SenderClock& leader) {
    const auto time = lockstep_->world_time(stamp);
    const sim::Time before = lockstep_->come_to(&leader);
    const bool leaps = !time || *time - before > StampLeap::longest_ahead ||
                       before - *time > StampLeap::longest_back;
    if (leaps) {
        const auto behind = time_behind_leap(stamp, leader);
        if (behind) leap(leader);
        if (!behind) (void)count(tl::unexpected(behind.error()));
        return behind;
    }
    if (*time > before) leader.leap().forget();
    lockstep_->begin_with(stamp);
    return *time;
}

sim::Expected<> PoseIntake::take_at(sim::Time time, const sim::PoseLine& line,
                                    std::string_view robot) {
    return count(told(place(line, robot, time)));
}

Placed PoseIntake::place(const sim::PoseLine& line, std::string_view robot, sim::Time time) {
    const Placement placement{time, line.pose, line.velocity, !line.time};
    Placed placed = !line.model.empty()   ? world_.place_model(line.model, placement)
                    : !line.robot.empty() ? world_.place_robot(line.robot, placement)
                    : !robot.empty()      ? world_.place_robot(robot, placement)
                                          : world_.place_only_robot(placement);
    if (placed && on_taken_) on_taken_(line, robot, time);
    return placed;
}

sim::Expected<> PoseIntake::count(sim::Expected<> taken) {
    if (taken) {
        ++accepted_;
    } else {
        ++refused_;
        last_refusal_ = taken.error().why;
    }
    return taken;
}

}  // namespace scipd::daemon
