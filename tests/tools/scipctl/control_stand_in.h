// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The daemon's control socket with nothing behind it: the real server and routes over two robots
// that go wherever they are put, at once, a door, and a scanner with one scan of two beams and with
// faults that never act. Lives on a thread of its own.
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <boost/asio/io_context.hpp>

#include "daemon/api/routes.h"
#include "daemon/device/sensor_record.h"
#include "daemon/http/http_server.h"
#include "tests/support/fake_faults.h"
#include "tests/support/temp_dir.h"

namespace scipd::tests {

struct Put {
    std::string robot;
    std::optional<sim::Time> time;
    sim::Pose pose;
    std::optional<sim::Velocity> velocity;
};

class ControlStandIn : EmptyApi {
  public:
    explicit ControlStandIn(std::vector<std::string> robots, std::string clock = "wall");
    ~ControlStandIn() override;
    ControlStandIn(const ControlStandIn&) = delete;
    ControlStandIn& operator=(const ControlStandIn&) = delete;

    [[nodiscard]] std::string socket() const { return directory_.path() / "control.sock"; }
    /// Everything that has been put, in order.
    [[nodiscard]] std::vector<Put> puts() const;
    /// The changes of the scene that were asked for, in order.
    [[nodiscard]] std::vector<daemon::SceneEdit> edits() const;
    /// Something has gone wrong at rescue/front.
    void log_fault(daemon::FaultLogEntry entry);

  private:
    [[nodiscard]] daemon::RigReport report() const override;
    [[nodiscard]] daemon::FaultsApi& faults() override { return faults_; }
    [[nodiscard]] std::optional<sim::TimedPose> robot_pose(const std::string& robot) const override;
    sim::Expected<> set_robot_pose(const std::string& robot, const sim::PoseLine& said) override;
    [[nodiscard]] std::optional<daemon::SensorLog> log(const std::string& sensor) const override;
    [[nodiscard]] daemon::SceneView scene() const override { return {"maze.sdf", scene_}; }
    void edit_scene(daemon::SceneEdit edit, daemon::EditDone done, std::stop_token) override;
    [[nodiscard]] std::optional<sim::TimedPose> model_pose(const std::string& model) const override;
    sim::Expected<> set_model_pose(const std::string& model, const sim::PoseLine& said) override;

    TempDir directory_;
    std::string clock_;
    mutable std::mutex mutex_;
    std::map<std::string, sim::Pose> poses_;
    std::vector<Put> puts_;
    std::vector<daemon::SceneEdit> edits_;
    sim::SharedScene scene_;
    daemon::ScanLog log_;
    FakeFaults faults_;
    boost::asio::io_context io_;
    daemon::HttpServer server_;
    std::thread thread_;
};

}  // namespace scipd::tests
