// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/fleet/shared_poses.h"

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

#include <spdlog/spdlog.h>

#include "daemon/fleet/pose_frame.h"
#include "daemon/fleet/vda5050.h"

namespace scipd::daemon {
namespace {

// Nothing drives far in that time.
constexpr auto look_around_time = std::chrono::milliseconds(100);

}  // namespace

SharedPoses::SharedPoses(const boost::asio::any_io_executor& executor, MqttLink& link,
                         const Topics& topics, const std::string& name, Parts parts)
    : link_(link),
      name_(name),
      world_(parts.world),
      intake_(parts.intake),
      clock_(parts.clock),
      timer_(executor),
      sender_(executor, link, topics, name),
      receiver_(executor, parts.world, parts.intake, parts.clock, parts.lockstep != nullptr,
                {.body_of = std::move(parts.body_of),
                 .matters =
                     [this](const sim::PoseLine& line) {
                         return line.model.empty() || !nearness_ || nearness_->matters(line);
                     },
                 .moved = [this](const std::string& model) { sender_.forget(model); }}) {
    if (parts.near_m) nearness_.emplace(*parts.near_m);
    if (parts.lockstep != nullptr) time_.emplace(link, topics, name, *parts.lockstep, parts.intake);
}

SharedPoses::~SharedPoses() {
    stop();
}

void SharedPoses::begin() {
    intake_.on_taken([this](const sim::PoseLine& line, std::string_view robot, sim::Time time) {
        tell_of(line, robot, time);
    });
    if (time_) time_->begin();
}

void SharedPoses::stop() {
    timer_.cancel();
    intake_.on_taken({});
    if (time_) time_->stop();
}

void SharedPoses::serve(const std::vector<RobotConfig>& robots) {
    bodies_.clear();
    for (const RobotConfig& robot : robots)
        bodies_[robot.name] = robot.body;
    listen_to(robots);
    const sim::Time now = clock_.now();
    for (const auto& [robot, body] : bodies_) {
        if (!body.empty()) tell_of({.robot = robot, .pose = world_.robot(robot)->at(now)}, {}, now);
    }
    if (nearness_) look_around();
}

void SharedPoses::look_around() {
    std::vector<glm::dvec3> robots_m;
    for (const auto& [robot, body] : bodies_)
        robots_m.push_back(world_.robot(robot)->at(clock_.now()).translation_m);
    for (const sim::PoseLine& line : nearness_->look_around(robots_m))
        receiver_.take_place(line);
    timer_.expires_after(look_around_time);
    timer_.async_wait([this](const boost::system::error_code& error) {
        if (!error) look_around();
    });
}

// A daemon that was started again goes on with what the one of its name had moved.
void SharedPoses::put(const Places& places, bool with_own) {
    std::multimap<sim::Time, sim::PoseLine> in_order;
    for (const auto& [sender, text] : places) {
        const bool own = sender == name_;
        if (own && !with_own) continue;
        for (sim::PoseLine& line : poses_in(text)) {
            if (is_own_body(line.model)) continue;
            const sim::Time when = line.time.value_or(sim::Time{});
            line.time = clock_.now();
            if (own) sender_.send(line);
            in_order.emplace(when, std::move(line));
        }
    }
    for (const auto& [when, line] : in_order)
        receiver_.take_place(line);
}

void SharedPoses::take(std::string_view frame) {
    const std::string_view sender = sender_of(frame);
    if (sender != name_) receiver_.take_frame(sender, frame);
}

void SharedPoses::take_step(std::string_view text) {
    if (time_) time_->take(text, receiver_);
}

void SharedPoses::listen_to(const std::vector<RobotConfig>& robots) {
    for (const auto& [topic, vehicle] : vehicles_)
        link_.unsubscribe(topic);
    vehicles_.clear();
    for (const RobotConfig& robot : robots) {
        if (robot.poses && robot.poses->kind == PoseSource::Kind::vda5050)
            vehicles_[vda5050_topic(robot.poses->vehicle, robot.name)].robot = robot.name;
    }
    ask_vehicles();
}

void SharedPoses::ask_vehicles() {
    for (const auto& [topic, vehicle] : vehicles_)
        link_.subscribe(topic);
}

// It drives on the ground, and the robot stays at its height.
void SharedPoses::take_vehicle(const std::string& topic, std::string_view state) {
    const auto found = vehicles_.find(topic);
    if (found == vehicles_.end()) return;
    Vehicle& vehicle = found->second;
    const sim::Time now = clock_.now();
    const auto taken = intake_.admit(vehicle.rate).and_then([&] {
        return parse_vda5050_state(state).and_then([&](sim::PoseLine line) {
            line.robot = vehicle.robot;
            line.pose.translation_m.z = world_.robot(vehicle.robot)->at(now).translation_m.z;
            return intake_.take(line, {}, vehicle.clock, now);
        });
    });
    if (taken) return;
    const auto others = vehicle.refusals_told.admit(std::chrono::steady_clock::now());
    if (others) spdlog::warn("pose of {} refused: {}{}", vehicle.robot, taken.error().why, *others);
}

bool SharedPoses::is_own_body(const std::string& model) const {
    return !model.empty() &&
           std::ranges::any_of(bodies_, [&](const auto& robot) { return robot.second == model; });
}

/// The body of a robot of this daemon; `robot` is meant by a line without a name.
std::string SharedPoses::own_body(const sim::PoseLine& line, std::string_view robot) const {
    const std::string_view named = line.robot.empty() ? robot : line.robot;
    if (named.empty()) return bodies_.size() == 1 ? bodies_.begin()->second : "";
    const auto found = bodies_.find(named);
    return found == bodies_.end() ? "" : found->second;
}

// Only the bodies of robots are seen. They go by the names of their models, which differ, while
// two daemons may well call their robots the same.
void SharedPoses::tell_of(const sim::PoseLine& line, std::string_view robot, sim::Time time) {
    sim::PoseLine told{.model = line.model.empty() ? own_body(line, robot) : line.model,
                       .time = time,
                       .pose = line.pose,
                       .velocity = line.velocity};
    if (told.model.empty()) return;
    if (!receiver_.taking()) return sender_.send(told);
    // All have heard it, but of a robot here nobody else keeps where it is.
    if (line.model.empty()) sender_.keep(told);
}

}  // namespace scipd::daemon
