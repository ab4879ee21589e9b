// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/poses/pose_intake.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <variant>

#include <spdlog/spdlog.h>

namespace scipd::daemon {
namespace {

// In floating point: stamps may lie farther apart than a Time can tell.
using Seconds = std::chrono::duration<double>;

// A stamp this far before the one ahead of it is no late packet: the sender has been started again.
// One that has gained as much on our clock since then is damaged, or the sender's clock was set.
constexpr Seconds largest_slip = StampLeap::longest_back;

// Jitter within this leaves poses exactly where their stamps say.
constexpr sim::Time dead_zone = std::chrono::milliseconds(100);
// Longer than packets are held up together.
constexpr sim::Time patience = std::chrono::milliseconds(500);
// Longer than what was held up takes to come in, shorter than what a sender drifts much in.
constexpr sim::Time portion = std::chrono::milliseconds(50);

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
    // Packets that were overtaken say nothing of the clock; equal stamps are one moment.
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

std::optional<std::string> PoseIntake::take_line(std::string_view line, std::string_view robot,
                                                 SenderClock& sender, sim::Time arrival) {
    const auto parsed = sim::parse_pose_line(line);
    if (const auto* refusal = std::get_if<std::string>(&parsed)) return count(*refusal);
    return take(std::get<sim::PoseLine>(parsed), robot, sender, arrival);
}

// In lockstep the senders' stamps are the time itself.
std::optional<std::string> PoseIntake::take(const sim::PoseLine& line, std::string_view robot,
                                            SenderClock& sender, sim::Time arrival) {
    if (lockstep_ == nullptr) return take_at(sender.world_time(line.time, arrival), line, robot);
    if (!line.time) return count("t is missing: time is that of the poses");
    return count(take_stamped(*line.time, line, robot, sender));
}

std::optional<std::string> PoseIntake::take_stamped(sim::Time stamp, const sim::PoseLine& line,
                                                    std::string_view robot, SenderClock& sender) {
    const auto time = lockstep_->world_time(stamp);
    const sim::Time before = lockstep_->come_to(&sender);
    if (!time || *time - before > StampLeap::longest_ahead)
        return take_leaping(stamp, line, robot, sender);
    const auto refusal = place(line, robot, *time);
    if (refusal == World::not_later && before - *time > StampLeap::longest_back)
        return take_leaping(stamp, line, robot, sender);
    if (refusal) return refusal;
    if (*time > before) sender.leap().forget();
    lockstep_->begin_with(stamp);
    lockstep_->come_to(&sender, *time, world_.has_one_mover());
    return std::nullopt;
}

// World time goes on from the last pose that was taken; where the stamps of it were, they go on
// from the first one behind the leap.
std::optional<std::string> PoseIntake::take_leaping(sim::Time stamp, const sim::PoseLine& line,
                                                    std::string_view robot, SenderClock& sender) {
    const sim::Time before = lockstep_->clock().origin() + lockstep_->come_to(&sender);
    const std::string leaps = "t: leaps" + from_to(before, stamp);
    if (!lockstep_->leads(&sender))
        return leaps + "; others lead time, and stamps must keep to theirs";
    if (!sender.leap().take(stamp))
        return leaps + "; a second of stamps that follow it makes it the time";
    const sim::Time first = sender.leap().first();
    const auto time = lockstep_->time_anew(&sender, first, stamp);
    if (!time) return leaps + ", too far for one run";
    if (auto refusal = place(line, robot, *time)) return refusal;
    if (const auto others = leaps_told_.admit(std::chrono::steady_clock::now())) {
        spdlog::warn("the stamps of poses have leapt{}: time goes on from there{}",
                     from_to(before, first), *others);
    }
    sender.leap().forget();
    lockstep_->begin_anew_with(&sender, first);
    lockstep_->come_to(&sender, *time, world_.has_one_mover());
    return std::nullopt;
}

std::optional<std::string> PoseIntake::take_at(sim::Time time, const sim::PoseLine& line,
                                               std::string_view robot) {
    return count(place(line, robot, time));
}

std::optional<std::string> PoseIntake::place(const sim::PoseLine& line, std::string_view robot,
                                             sim::Time time) {
    const Placement placement{time, line.pose, line.velocity, !line.time};
    if (!line.model.empty()) return world_.place_model(line.model, placement);
    if (!line.robot.empty()) return world_.place_robot(line.robot, placement);
    if (!robot.empty()) return world_.place_robot(robot, placement);
    return world_.place_only_robot(placement);
}

std::optional<std::string> PoseIntake::count(std::optional<std::string> refusal) {
    if (refusal) {
        ++refused_;
        last_refusal_ = refusal;
    } else {
        ++accepted_;
    }
    return refusal;
}

}  // namespace scipd::daemon
