// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A daemon with nothing in it. Tests override what they need.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "daemon/api/api.h"
#include "daemon/api/faults_api.h"
#include "daemon/api/recordings.h"
#include "daemon/api/scan_stream.h"
#include "daemon/api/scene_gallery.h"
#include "daemon/clock/stepped_clock.h"
#include "daemon/config/added_sensor.h"
#include "daemon/config/config.h"

namespace scipd::tests {

/// No scanner can have faults.
class EmptyFaults : public daemon::FaultsApi {
  public:
    [[nodiscard]] std::vector<std::string> scanners() const override { return {}; }
    daemon::FaultStarted start(const std::string&, daemon::FaultPlan) override { return {}; }
    bool stop(const std::string&, std::uint64_t) override { return false; }
    void stop_all(const std::string&) override {}
    [[nodiscard]] std::vector<daemon::FaultStatus> list(const std::string&) const override {
        return {};
    }
    [[nodiscard]] daemon::FaultLog::Entries log(const std::string&) const override { return {}; }
    void run(daemon::Scenario) override {}
    void stop_scenario() override {}
    [[nodiscard]] std::optional<daemon::ScenarioStatus> scenario() const override { return {}; }
};

class EmptyApi : public daemon::Api {
  public:
    [[nodiscard]] daemon::RigReport report() const override { return {}; }
    [[nodiscard]] daemon::Config configuration() const override { return {}; }
    void add_sensor(daemon::AddedSensor, daemon::EditDone done, std::stop_token) override {
        done({});
    }
    void remove_sensor(const std::string&, const std::string&, daemon::EditDone done,
                       std::stop_token) override {
        done({});
    }
    [[nodiscard]] std::optional<daemon::SensorRecord> latest(const std::string& sensor) override {
        const auto kept = log(sensor);
        if (!kept) return {};
        return std::visit([](const auto& of) -> daemon::SensorRecord { return of.latest(); },
                          *kept);
    }
    [[nodiscard]] std::optional<daemon::SensorLog> log(const std::string&) const override {
        return {};
    }
    [[nodiscard]] std::optional<daemon::ReadingErrors> errors(const std::string&) const override {
        return {};
    }
    sim::Expected<> set_errors(const std::string&, const daemon::ReadingErrors&) override {
        return {};
    }
    [[nodiscard]] std::optional<daemon::ReplayStatus> replay(const std::string&) const override {
        return {};
    }
    daemon::ReplayStatus steer_replay(const std::string&, const daemon::ReplaySteering&) override {
        return {};
    }
    void ask_log(const std::string&) override {}
    std::unique_ptr<daemon::Conversation> subscribe(const std::string& sensor,
                                                    daemon::WebSocket& socket) override {
        return stream_.subscribe(sensor, socket);
    }
    std::unique_ptr<daemon::Conversation> open_wire(const std::string&,
                                                    daemon::WebSocket&) override {
        return nullptr;
    }
    std::unique_ptr<daemon::Conversation> open_view(daemon::WebSocket&) override { return nullptr; }
    [[nodiscard]] std::optional<sim::TimedPose> robot_pose(const std::string&) const override {
        return {};
    }
    sim::Expected<> set_robot_pose(const std::string&, const sim::PoseLine&) override { return {}; }
    sim::Expected<> admit_pose(daemon::Rate&) override { return {}; }
    sim::Expected<> take_pose_line(std::string_view, daemon::SenderClock&) override { return {}; }
    daemon::ScanStream& stream() { return stream_; }
    [[nodiscard]] daemon::SceneView scene() const override { return {"empty.sdf", scene_}; }
    [[nodiscard]] daemon::WorldView world() const override {
        const sim::SharedScene now = scene().scene;
        daemon::WorldView view{.version = "1",
                               .loaded = "1",
                               .most_body_bytes = 1000,
                               .scene = now,
                               .materials = std::make_shared<const sim::MaterialLibrary>()};
        for (const sim::Model& model : now->models)
            view.models.push_back(model.world_from_model);
        return view;
    }
    [[nodiscard]] daemon::SceneGallery& gallery() override { return gallery_; }
    [[nodiscard]] daemon::Recordings& recordings() override { return recordings_; }
    void edit_scene(daemon::SceneEdit, daemon::EditDone done, std::stop_token) override {
        done({});
    }
    [[nodiscard]] std::vector<sim::Medium> media() const override { return media_; }
    [[nodiscard]] std::vector<std::string> set_media(std::vector<sim::Medium> media) override {
        media_ = std::move(media);
        return {};
    }
    [[nodiscard]] std::optional<sim::TimedPose> model_pose(const std::string&) const override {
        return {};
    }
    sim::Expected<> set_model_pose(const std::string&, const sim::PoseLine&) override { return {}; }
    [[nodiscard]] daemon::FaultsApi& faults() override { return faults_; }

  private:
    sim::SharedScene scene_ = std::make_shared<const sim::Scene>();
    std::vector<sim::Medium> media_;
    daemon::ScanStream stream_;
    daemon::SteppedClock clock_;
    daemon::Recordings recordings_{
        {}, clock_, [](const daemon::Worker::Begin& begin) { begin()()(); }};
    EmptyFaults faults_;
    daemon::SceneGallery gallery_{
        [](const daemon::Worker::Begin& begin) { begin()()(); }};  // here and now
};

}  // namespace scipd::tests
