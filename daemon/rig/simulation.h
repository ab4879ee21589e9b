// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One world in time: the scene with its robots, the sensors in it, and whatever changes it. Rig
// configures it, RigApi reads and changes it for the control API. Lives on the I/O thread. But
// the sensors with their ports live on shards, and are touched while the shards stand still.
#pragma once

#include <atomic>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <boost/asio/any_io_executor.hpp>

#include "daemon/api/recordings.h"
#include "daemon/api/scan_stream.h"
#include "daemon/api/view_stream.h"
#include "daemon/api/wire_stream.h"
#include "daemon/clock/wall_clock.h"
#include "daemon/device/sensor_counts.h"
#include "daemon/faults/scenario_run.h"
#include "daemon/limits/limits.h"
#include "daemon/plan/rig_plan.h"
#include "daemon/poses/lockstep.h"
#include "daemon/poses/pose_feed.h"
#include "daemon/poses/pose_intake.h"
#include "daemon/rig/stations.h"
#include "daemon/shards/shards.h"
#include "daemon/world/backend_chooser.h"
#include "daemon/world/place_watch.h"
#include "daemon/world/scene_editor.h"
#include "daemon/world/worker.h"
#include "daemon/world/world.h"

namespace scipd::daemon {

struct Simulation {
    /// Its sensors live on `shards` threads; on this one where that is 1, and in lockstep.
    Simulation(const boost::asio::any_io_executor& executor, ClockKind clock, std::size_t shards);

    /// From here to sensors and back.
    [[nodiscard]] ScanStream::Ways ways();
    /// What all sensors ask of the backends, as they are now.
    [[nodiscard]] std::vector<RequestedBackend> requested_backends() const;
    /// Measures, in a while, which backends are to cast for the sensors that leave it open, and
    /// again for those whose scene has changed much since.
    void choose_backends();
    /// What a configuration that comes need not find out again.
    [[nodiscard]] KnownSensors known_sensors();
    /// Mounts each sensor where the scene has the place it is mounted on. Returns a warning for
    /// each place that the scene does not have.
    [[nodiscard]] std::vector<std::string> remount();
    /// All scanners: what a scenario is for.
    [[nodiscard]] std::vector<ScenarioRun::Target> scanners();
    [[nodiscard]] ScenarioRun::Target target_of(const Station& scanner);

    const SharedLimits limits = std::make_shared<Limits>();
    WallClock wall_clock;
    std::unique_ptr<Lockstep> lockstep;  ///< null: on the wall clock
    Clock& clock;
    World world;
    Shards shards;
    PoseIntake intake{world, lockstep.get(), limits};
    std::vector<std::shared_ptr<const PoseFeed>> feeds;  ///< what brings it poses
    SceneEditor editor;
    std::atomic<int> clients = 0;  ///< of all scanners, now
    BackendChooser chooser;
    PlaceWatch place_watch{world, worker};
    std::vector<std::unique_ptr<PlaceGlance>> place_glances;  ///< by shard
    ScanStream stream;
    ViewStream view;
    WireStream wire;
    Recordings recordings;
    Stations stations;
    std::map<std::string, SensorCounts> counted_before;  ///< by sensors that are gone, by name
    ScenarioRun scenario;
    Worker worker;  ///< loads worlds and measures backends, one after the other
    /// Makes what pages draw, which does not wait for that. It works often and little: whoever
    /// gives memory back has others wait who take some.
    Worker drawer;

  private:
    void tell_of_late(std::size_t shard) const;
};

}  // namespace scipd::daemon
