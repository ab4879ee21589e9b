// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// All robots and scanners of a configuration, in one world, with their ports and pose feeds. A new
// configuration is applied as a whole or not at all: everything that can fail is done before
// anything of the old is touched, and scanners that did not change keep their connections and their
// scan numbers. Lives on the I/O thread.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <boost/asio/any_io_executor.hpp>

#include "daemon/api/api.h"
#include "daemon/api/scan_stream.h"
#include "daemon/clock/wall_clock.h"
#include "daemon/config/config.h"
#include "daemon/fleet_plan.h"
#include "daemon/link/pty_port.h"
#include "daemon/link/tcp_port.h"
#include "daemon/poses/lockstep.h"
#include "daemon/poses/pose_feed.h"
#include "daemon/poses/pose_intake.h"
#include "daemon/station.h"
#include "daemon/world/backend_chooser.h"
#include "daemon/world/place_watch.h"
#include "daemon/world/scene_editor.h"
#include "daemon/world/worker.h"
#include "daemon/world/world.h"

namespace scipd::daemon {

class Fleet : public Api {
  public:
    explicit Fleet(const boost::asio::any_io_executor& executor, ClockKind clock = ClockKind::wall);
    /// As stop().
    ~Fleet() override;

    /// Throws LoadError for a trajectory, std::runtime_error for a port or a source of poses: then
    /// all is as before.
    void apply(FleetPlan&& plan);
    void apply(const Config& config) { apply(make_plan(config)); }
    /// Settles by measuring, in a while, which backends cast for sensors that leave it open, and
    /// again for those whose scene has changed much since.
    void choose_backends();
    /// What a configuration that comes need not measure again.
    [[nodiscard]] SettledBackends settled_backends() const;
    void stop();
    /// Where worlds are loaded, one after the other.
    [[nodiscard]] Worker& worker() { return worker_; }

    /// Of robots whose poses come by UDP.
    [[nodiscard]] std::map<std::string, Address> pose_addresses() const;

    [[nodiscard]] Status status() const override;
    [[nodiscard]] const ScanLog* scans(const std::string& sensor) const override;
    [[nodiscard]] StaringSensor* staring(const std::string& sensor) override;
    [[nodiscard]] std::optional<sim::TimedPose> robot_pose(const std::string& robot) const override;
    std::optional<std::string> set_robot_pose(const std::string& robot,
                                              const sim::PoseLine& said) override;
    std::optional<std::string> take_pose_line(std::string_view line, SenderClock& sender) override;
    ScanStream& stream() override { return stream_; }
    [[nodiscard]] SceneView scene() const override;
    void edit_scene(SceneEdit edit, EditDone done, std::stop_token withdrawn) override;
    [[nodiscard]] std::optional<sim::TimedPose> model_pose(const std::string& model) const override;
    std::optional<std::string> set_model_pose(const std::string& model,
                                              const sim::PoseLine& said) override;

  private:
    /// By what the configuration asks for, so that a port outlives a change of the scanner behind
    /// it.
    struct Ports {
        std::map<std::string, std::shared_ptr<TcpPort>> tcp;
        std::map<std::string, std::shared_ptr<PtyPort>> pty;
    };

    struct Feed {
        std::string robot;
        PoseSource source;
        std::shared_ptr<PoseFeed> feed;
    };

    using Stations = std::vector<std::unique_ptr<Station>>;

    /// With all that it takes to serve those devices that will be new.
    [[nodiscard]] Ports open_ports(const Config& config) const;
    /// The second half of apply(), in which nothing can fail.
    void take_up(FleetPlan&& plan, Ports ports, std::vector<Feed> feeds) noexcept;
    [[nodiscard]] std::vector<Feed> open_feeds(const Config& config);
    void replace_stations(const Config& config, const Ports& ports) noexcept;
    /// Of the same robot and seed, and configured like this.
    [[nodiscard]] Stations::const_iterator find_unchanged(const std::string& robot,
                                                          const SensorConfig& sensor,
                                                          std::uint64_t seed) const;
    [[nodiscard]] std::unique_ptr<Station> take_unchanged(const std::string& robot,
                                                          const SensorConfig& sensor,
                                                          std::uint64_t seed);
    [[nodiscard]] std::unique_ptr<Station> power_up(const RobotConfig& robot,
                                                    const SensorConfig& sensor, std::uint64_t seed,
                                                    const Ports& ports);
    void replace_feeds(std::vector<Feed> feeds) noexcept;
    [[nodiscard]] const Station* find(const std::string& sensor) const;
    /// By the places that the world has now; answers with a warning for each that it has not.
    [[nodiscard]] std::vector<std::string> remount();
    /// Null has none.
    [[nodiscard]] std::optional<sim::TimedPose> pose_now(const sim::PoseTrack* track) const;
    [[nodiscard]] SensorStatus status_of(const Station& station) const;
    /// Of all sensors, as they are now.
    [[nodiscard]] std::vector<RequestedBackend> requested_backends() const;

    boost::asio::any_io_executor executor_;
    WallClock wall_clock_;
    std::unique_ptr<Lockstep> lockstep_;  ///< null: on the wall clock
    Clock& clock_;
    World world_;
    PoseIntake intake_{world_, lockstep_.get()};
    SceneEditor editor_;
    BackendChooser chooser_;
    PlaceWatch place_watch_{world_, worker_};
    ScanStream stream_;
    Ports ports_;
    Stations stations_;
    std::vector<Feed> feeds_;
    std::map<std::string, SenderClock>
        api_senders_;  ///< of robots that are moved through the control API
    std::map<std::string, SenderClock> api_model_senders_;
    Worker worker_;
};

}  // namespace scipd::daemon
