// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the control API asks of the daemon, and the values that the daemon answers with. On the I/O
// thread; only handlers and WebSockets call it.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/api/rig_report.h"
#include "daemon/api/world_view.h"
#include "daemon/device/sensor_log.h"
#include "daemon/http/web_socket.h"
#include "daemon/replay/replay.h"
#include "daemon/world/scene_edit.h"
#include "sim/expected.h"
#include "sim/loaders/poses/pose_line.h"
#include "sim/loaders/poses/trajectory.h"
#include "sim/time.h"
#include "sim/world/medium.h"
#include "sim/world/pose.h"
#include "sim/world/scene.h"

namespace scipd::daemon {

class FaultsApi;
class Rate;
class Recordings;
class SceneGallery;
class SenderClock;
struct AddedSensor;
struct Config;

struct SceneView {
    std::filesystem::path file;
    sim::SharedScene scene;
};

/// Times are those that people have: in lockstep the stamps of their poses. Nothing here throws.
class Api {
  public:
    virtual ~Api() = default;

    [[nodiscard]] virtual RigReport report() const = 0;

    /// What is running, as it stands now: with the poses of robots, what fills the air, and how
    /// well scanners read.
    [[nodiscard]] virtual Config configuration() const = 0;

    /// Calls `done` as edit_scene() does. Nobody who is served by another sensor notices.
    virtual void add_sensor(AddedSensor sensor, EditDone done, std::stop_token withdrawn) = 0;
    virtual void remove_sensor(const std::string& robot, const std::string& sensor, EditDone done,
                               std::stop_token withdrawn) = 0;

    /// The latest measurement of "rescue/front". A scanner has none (null) before anybody asks it
    /// for scans; a camera or ranger measures now. Nothing: there is no such sensor.
    [[nodiscard]] virtual std::optional<SensorRecord> latest(const std::string& sensor) = 0;

    /// How well it reads now; nothing: there is no such scanner.
    [[nodiscard]] virtual std::optional<ReadingErrors> errors(const std::string& sensor) const = 0;
    /// From its next scan on it reads like this. Of a scanner that is there.
    [[nodiscard]] virtual sim::Expected<> set_errors(const std::string& sensor,
                                                     const ReadingErrors& errors) = 0;

    /// How it stands with the recording that it plays; nothing: it plays none.
    [[nodiscard]] virtual std::optional<ReplayStatus> replay(const std::string& sensor) const = 0;
    /// Holds from the next scan on. The scanner must play one. Returns the status after a step.
    virtual ReplayStatus steer_replay(const std::string& sensor,
                                      const ReplaySteering& steering) = 0;

    /// The measurements of the sensor that are kept: the latest, and those of a second where
    /// somebody has asked for its truth. Nothing: there is no such sensor.
    [[nodiscard]] virtual std::optional<SensorLog> log(const std::string& sensor) const = 0;
    /// Somebody asks for the truth of a sensor that is there. For a minute from now on those of a
    /// second are kept.
    virtual void ask_log(const std::string& sensor) = 0;

    /// Begins to send all measurements of a sensor that is there; `sensor` empty: of all sensors.
    virtual std::unique_ptr<Conversation> subscribe(const std::string& sensor,
                                                    WebSocket& socket) = 0;

    /// What clients record of scanners that are there.
    [[nodiscard]] virtual Recordings& recordings() = 0;

    /// Begins to send a page what it draws.
    virtual std::unique_ptr<Conversation> open_view(WebSocket& page) = 0;
    /// Begins to tell what goes over the wire of a sensor that is there.
    virtual std::unique_ptr<Conversation> open_wire(const std::string& sensor, WebSocket&) = 0;

    /// The pose now, and what time it is; nothing: there is no such robot.
    [[nodiscard]] virtual std::optional<sim::TimedPose> robot_pose(
        const std::string& robot) const = 0;

    /// `robot` exists, and it is the one that is meant. The time is the sender's; without one the
    /// pose is of now. The pose holds when this returns, unless it is refused.
    [[nodiscard]] virtual sim::Expected<> set_robot_pose(const std::string& robot,
                                                         const sim::PoseLine& said) = 0;

    /// To be asked before each pose that a connection brings: whether that is not too many.
    [[nodiscard]] virtual sim::Expected<> admit_pose(Rate& sender) = 0;

    /// One line of a stream of many.
    [[nodiscard]] virtual sim::Expected<> take_pose_line(std::string_view line,
                                                         SenderClock& sender) = 0;

    [[nodiscard]] virtual SceneView scene() const = 0;
    [[nodiscard]] virtual WorldView world() const = 0;
    /// Makes what pages draw of the scene.
    [[nodiscard]] virtual SceneGallery& gallery() = 0;

    /// Calls `done` when the change is in effect or refused, after the changes before it. Does not
    /// call it where the change is withdrawn before it has begun.
    virtual void edit_scene(SceneEdit edit, EditDone done, std::stop_token withdrawn) = 0;

    /// What fills the air now.
    [[nodiscard]] virtual std::vector<sim::Medium> media() const = 0;
    /// It is this from the next measurement on. Returns what is worth knowing about it.
    [[nodiscard]] virtual std::vector<std::string> set_media(std::vector<sim::Medium> media) = 0;

    /// As of robots; nothing: there is no such movable model.
    [[nodiscard]] virtual std::optional<sim::TimedPose> model_pose(
        const std::string& model) const = 0;
    [[nodiscard]] virtual sim::Expected<> set_model_pose(const std::string& model,
                                                         const sim::PoseLine& said) = 0;

    [[nodiscard]] virtual FaultsApi& faults() = 0;
};

}  // namespace scipd::daemon
