// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/tools/scipctl/control_stand_in.h"

#include <chrono>
#include <limits>
#include <utility>

#include <boost/asio/post.hpp>

#include "tests/support/scene_builder.h"

namespace scipd::tests {

ControlStandIn::ControlStandIn(std::vector<std::string> robots, std::string clock)
    : clock_(std::move(clock)),
      server_(io_.get_executor(),
              [this](const daemon::HttpRequest& request, daemon::Respond respond) {
                  daemon::route(*this, request, std::move(respond));
              }) {
    scene_ = sim::SceneBuilder()
                 .add(sim::Box{{1, 1, 1}}, {}, 1)
                 .movable({{1, 2, 0}, {1, 0, 0, 0}})
                 .with(sim::Box{{1, 1, 1}}, {})
                 .build();
    sim::Scene with_lidars = *scene_;
    const sim::Pose turned = sim::pose_from_rpy({0.5, 0, 0.25}, {0, 0, 1});
    with_lidars.frames = {
        {"model 1::l", 1, {}, {}, {}},
        {"model 1::l::eye", 1, {}, "camera", {}},
        {"model 1::l::lds", 1, turned, "ray", sim::Lidar{360, 1, 0.0, 6.28, 0.12, 3.5, 5.0}},
        {"model 0::l::top",
         0,
         {},
         "gpu_lidar",
         sim::Lidar{1081, 16, -2.3562, 2.3562, 0.02, std::numeric_limits<double>::infinity(), 0}}};
    scene_ = std::make_shared<const sim::Scene>(std::move(with_lidars));
    sim::Scan scan{.revolution = 7, .start = std::chrono::seconds(2)};
    scan.world_from_sensor = {{}};
    scan.posed_at = {scan.start};
    scan.hits = {{1.5F, 1.0F, 1, 0}, {}};
    scan.echoes.add({.range_m = 1.5F, .power = 0.25F, .object = 0, .material = 1});
    scan.echoes.add({.range_m = 4.0F, .power = 0.01F});
    scan.echoes.finish_beam();
    scan.echoes.finish_beam();
    scan.readings = {{.range_m = 1.501F, .cause = sim::Cause::measured}, {}};
    daemon::ScanRecord record;
    record.cast = std::make_shared<const sim::Scan>(scan);
    record.sent = {.first_step = 44, .distance = {1501, 1}, .intensity = {900, 0}};
    record.sent.echoes = {{.echo = {{{1501, 900}, {4003, 40}}}, .count = 2},
                          {.echo = {{{1, 0}}}, .count = 1}};
    record.accuracy = sim::Accuracy::material;
    record.optics = std::make_shared<const sim::SensorSpec>(
        sim::SensorSpec{.bias = {{1.0, 0.001}, {2.0, 0.001}}});
    record.stamp_ms = 2000;
    record.scene = scene_;
    record.backend = std::make_shared<const daemon::BackendChoice>(
        daemon::BackendChoice{"embree", "embree takes 0.030 ms, depth takes 0.600 ms", 12});
    record.front_step = 384;
    record.steps_per_turn = 1024;
    log_.add(std::make_shared<const daemon::ScanRecord>(std::move(record)), {});
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

void ControlStandIn::log_fault(daemon::FaultLogEntry entry) {
    boost::asio::post(io_, [this, entry = std::move(entry)] { faults_.entries.add(entry); });
}

daemon::RigReport ControlStandIn::report() const {
    daemon::RigReport report;
    report.uptime = std::chrono::seconds(90);
    report.clock = clock_;
    report.time = std::chrono::milliseconds(12345);
    report.scene = "maze.sdf";
    report.poses = {.accepted = 7, .refused = 1, .last_refusal = "xyz is missing"};
    report.poses.sources = {{.robot = "rescue",
                             .source = "ros2:/odm",
                             .type = "nav_msgs/Odometry",
                             .messages = 1200,
                             .refused = 3,
                             .lost = 0,
                             .rate_hz = 50.04,
                             .age_s = 0.012,
                             .late_ms = 4.26,
                             .most_late_ms = 11.5,
                             .troubles = {"no publisher of /odm; did you mean '/odom'?"}},
                            {.robot = "other", .source = "udp:127.0.0.1:14550"}};
    for (const auto& [robot, pose] : poses_) {
        report.sensors.push_back({.name = robot + "/front",
                                  .model = "UST-10LX",
                                  .backend = "embree",
                                  .state = "streaming",
                                  .tcp = "127.0.0.1:10940",
                                  .pty = {},
                                  .clients = 1,
                                  .connected = {"127.0.0.1:49152"},
                                  .waiting = {"127.0.0.1:49160"},
                                  .faults = {"stall", "cut", "stall"},
                                  .counts = {.scans = 4000, .lost = 2},
                                  .stream_lost = 3});
    }
    return report;
}

std::optional<sim::TimedPose> ControlStandIn::robot_pose(const std::string& robot) const {
    const std::scoped_lock lock(mutex_);
    const auto found = poses_.find(robot);
    if (found == poses_.end()) return std::nullopt;
    return sim::TimedPose{{}, found->second};
}

sim::Expected<> ControlStandIn::set_robot_pose(const std::string& robot,
                                               const sim::PoseLine& said) {
    if (said.pose.translation_m.x > 1000.0) return sim::refuse("that is outside the world");
    const std::scoped_lock lock(mutex_);
    poses_[robot] = said.pose;
    puts_.push_back({robot, said.time, said.pose, said.velocity});
    return {};
}

std::optional<daemon::SensorLog> ControlStandIn::log(const std::string& sensor) const {
    return sensor.ends_with("/front") ? std::optional<daemon::SensorLog>(log_) : std::nullopt;
}

std::vector<daemon::SceneEdit> ControlStandIn::edits() const {
    const std::scoped_lock lock(mutex_);
    return edits_;
}

void ControlStandIn::edit_scene(daemon::SceneEdit edit, daemon::EditDone done, std::stop_token) {
    using Result = daemon::EditOutcome::Result;
    const auto* const added = std::get_if<daemon::AddModel>(&edit);
    const auto* const removed = std::get_if<daemon::RemoveModel>(&edit);
    if (added != nullptr && added->placement.name == "model 1" && !added->replace) {
        return done({Result::taken, {"taken"}});
    }
    if (removed != nullptr && !sim::find_model(*scene_, removed->name)) {
        return done({Result::unknown, {"unknown"}});
    }
    const std::scoped_lock lock(mutex_);
    edits_.push_back(std::move(edit));
    done({Result::done, {"the sun is nothing to a scanner"}});
}

std::optional<sim::TimedPose> ControlStandIn::model_pose(const std::string& model) const {
    if (model != "model 1") return std::nullopt;
    return sim::TimedPose{{}, scene_->models[1].world_from_model};
}

sim::Expected<> ControlStandIn::set_model_pose(const std::string& model,
                                               const sim::PoseLine& said) {
    const std::scoped_lock lock(mutex_);
    puts_.push_back({model, said.time, said.pose, said.velocity});
    return {};
}

}  // namespace scipd::tests
