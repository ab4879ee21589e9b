// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/control/pose_intake.h"

#include <variant>

namespace scipd::daemon {
namespace {

// In floating point: stamps may lie farther apart than a Time can tell.
using Seconds = std::chrono::duration<double>;

// A stamp this far before the one ahead of it is no late packet: the sender has been started again.
// One that has gained as much on our clock since then is damaged, or the sender's clock was set.
constexpr Seconds leap{1.0};

}  // namespace

sim::Time SenderClock::world_time(std::optional<sim::Time> stamp, sim::Time arrival) {
    if (!stamp) return arrival;
    const Seconds passed = Seconds(*stamp) - Seconds(last_stamp_);
    const bool leapt = passed < -leap || passed - Seconds(arrival - last_arrival_) > leap;
    if (!world_minus_sender_ || leapt) world_minus_sender_ = arrival - *stamp;
    last_stamp_ = *stamp;
    last_arrival_ = arrival;
    return *stamp + *world_minus_sender_;
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
    const auto time = lockstep_->world_time(*line.time);
    if (!time) return count("t: too far from the first one");
    auto refusal = take_at(*time, line, robot);
    if (refusal) return refusal;
    lockstep_->begin_with(*line.time);
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
