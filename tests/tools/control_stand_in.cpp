// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/tools/control_stand_in.h"

#include <chrono>
#include <utility>

#include <boost/asio/post.hpp>

namespace scipd::tests {

ControlStandIn::ControlStandIn(std::vector<std::string> robots, std::string clock)
    : clock_(std::move(clock)),
      server_(io_.get_executor(),
              [this](const daemon::HttpRequest& request, daemon::Respond respond) {
                  daemon::route(*this, request, std::move(respond));
              }) {
    for (std::string& robot : robots)
        poses_[std::move(robot)] = {};
    server_.listen(socket());
    thread_ = std::thread([this] { io_.run(); });
}

ControlStandIn::~ControlStandIn() {
    boost::asio::post(io_, [this] { server_.close(); });
    thread_.join();
}

std::vector<Put> ControlStandIn::puts() const {
    const std::scoped_lock lock(mutex_);
    return puts_;
}

daemon::Status ControlStandIn::status() const {
    daemon::Status status;
    status.uptime = std::chrono::seconds(90);
    status.clock = clock_;
    status.time = std::chrono::milliseconds(12345);
    status.scene = "maze.sdf";
    status.poses = {.accepted = 7, .refused = 1, .last_refusal = "xyz is missing"};
    for (const auto& [robot, pose] : poses_) {
        status.sensors.push_back({.name = robot + "/front",
                                  .model = "UST-10LX",
                                  .backend = "embree",
                                  .state = "streaming",
                                  .tcp = "127.0.0.1:10940",
                                  .pty = {},
                                  .clients = 1,
                                  .scans = 4000,
                                  .lost = 2,
                                  .lateness = {}});
    }
    return status;
}

std::optional<sim::TimedPose> ControlStandIn::robot_pose(const std::string& robot) const {
    const std::scoped_lock lock(mutex_);
    const auto found = poses_.find(robot);
    if (found == poses_.end()) return std::nullopt;
    return sim::TimedPose{{}, found->second};
}

std::optional<std::string> ControlStandIn::set_robot_pose(const std::string& robot,
                                                          std::optional<sim::Time> time,
                                                          const sim::Pose& world_from_robot) {
    if (world_from_robot.translation_m.x > 1000.0) return "that is outside the world";
    const std::scoped_lock lock(mutex_);
    poses_[robot] = world_from_robot;
    puts_.push_back({robot, time, world_from_robot});
    return std::nullopt;
}

}  // namespace scipd::tests
