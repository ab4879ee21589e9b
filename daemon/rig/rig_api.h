// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the control API asks of a running rig: it reads and changes the simulation. Lives on the
// I/O thread.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/api/api.h"
#include "daemon/api/scene_gallery.h"
#include "daemon/poses/pose_intake.h"
#include "daemon/rig/rig_faults.h"

namespace scipd::daemon {

class SensorEditor;
class SharedWorld;
struct Simulation;

class RigApi : public Api {
  public:
    /// `simulation` must outlive it.
    explicit RigApi(Simulation& simulation);

    /// From now on changes of the world are those of others, too; null: of this daemon alone.
    void share(SharedWorld* shared) { shared_ = shared; }
    /// What is running from now on, and who has sensors come and go. They must outlive this.
    void run_as(const Config& config, SensorEditor& sensors) {
        config_ = &config;
        sensors_ = &sensors;
    }
    /// Without telling anybody who shares the world.
    void edit_here(SceneEdit edit, EditDone done, std::stop_token withdrawn = {});

    [[nodiscard]] RigReport report() const override;
    [[nodiscard]] Config configuration() const override;
    void add_sensor(AddedSensor sensor, EditDone done, std::stop_token withdrawn) override;
    void remove_sensor(const std::string& robot, const std::string& sensor, EditDone done,
                       std::stop_token withdrawn) override;
    [[nodiscard]] std::optional<SensorRecord> latest(const std::string& sensor) override;
    [[nodiscard]] std::optional<SensorLog> log(const std::string& sensor) const override;
    [[nodiscard]] std::optional<ReadingErrors> errors(const std::string& sensor) const override;
    sim::Expected<> set_errors(const std::string& sensor, const ReadingErrors& errors) override;
    [[nodiscard]] std::optional<ReplayStatus> replay(const std::string& sensor) const override;
    ReplayStatus steer_replay(const std::string& sensor, const ReplaySteering& steering) override;
    void ask_log(const std::string& sensor) override;
    std::unique_ptr<Conversation> subscribe(const std::string& sensor, WebSocket& socket) override;
    std::unique_ptr<Conversation> open_view(WebSocket& page) override;
    std::unique_ptr<Conversation> open_wire(const std::string& sensor, WebSocket&) override;
    [[nodiscard]] std::optional<sim::TimedPose> robot_pose(const std::string& robot) const override;
    sim::Expected<> set_robot_pose(const std::string& robot, const sim::PoseLine& said) override;
    sim::Expected<> admit_pose(Rate& sender) override;
    sim::Expected<> take_pose_line(std::string_view line, SenderClock& sender) override;
    [[nodiscard]] SceneView scene() const override;
    [[nodiscard]] WorldView world() const override;
    [[nodiscard]] SceneGallery& gallery() override { return gallery_; }
    [[nodiscard]] Recordings& recordings() override;
    void edit_scene(SceneEdit edit, EditDone done, std::stop_token withdrawn) override;
    [[nodiscard]] std::vector<sim::Medium> media() const override;
    [[nodiscard]] std::vector<std::string> set_media(std::vector<sim::Medium> media) override;
    [[nodiscard]] std::optional<sim::TimedPose> model_pose(const std::string& model) const override;
    sim::Expected<> set_model_pose(const std::string& model, const sim::PoseLine& said) override;
    [[nodiscard]] FaultsApi& faults() override { return faults_; }

  private:
    Simulation& simulation_;
    SharedWorld* shared_ = nullptr;
    const Config* config_ = nullptr;
    SensorEditor* sensors_ = nullptr;
    RigFaults faults_;
    SceneGallery gallery_;
    const std::string run_;  ///< of this daemon, which another one has not
    std::map<std::string, SenderClock> robot_senders_;  ///< of robots that the API moves
    std::map<std::string, SenderClock> model_senders_;
};

}  // namespace scipd::daemon
