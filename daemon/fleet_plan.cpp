// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/fleet_plan.h"

#include <utility>

#include "daemon/load_world.h"
#include "daemon/mounting.h"
#include "sim/sensor/beam_pattern.h"

namespace scipd::daemon {
namespace {

std::vector<glm::vec3> directions_of(const SensorConfig& sensor) {
    if (sensor.staring) return sensor.staring->directions();
    const sim::BeamPattern pattern(sensor.model.optics);
    return {pattern.directions().begin(), pattern.directions().end()};
}

}  // namespace

BackendWish backend_wish(const std::string& robot, const SensorConfig& sensor,
                         const sim::Pose& world_from_robot, ClockKind clock) {
    const double max_range_m =
        sensor.staring ? sensor.staring->max_range_m : sensor.model.optics.max_range_m;
    std::vector<glm::vec3> directions = directions_of(sensor);
    const auto beams = static_cast<int>(directions.size());
    BackendWish wish{.sensor = sensor_name(robot, sensor.name),
                     .backend = sensor.backend,
                     .depth = sensor.depth,
                     .directions = std::move(directions),
                     .poses = sensor.motion.value_or(beams),
                     .world_from_sensor = world_from_robot * sensor.robot_from_sensor,
                     .max_range_m = static_cast<float>(max_range_m)};
    if (clock == ClockKind::poses)
        wish.settled = rays_unmeasured("in lockstep two runs have to be the same");
    return wish;
}

FleetPlan make_plan(Config config, const SettledBackends& settled, const std::stop_token& stop) {
    sim::LoadedScene loaded = load_world(config, stop);
    std::vector<std::string> notices = mount_by_name(config, *loaded.scene);
    std::vector<BackendWish> wishes;
    for (const RobotConfig& robot : config.robots) {
        for (const SensorConfig& sensor : robot.sensors) {
            BackendWish wish =
                backend_wish(robot.name, sensor, robot.world_from_robot, config.clock);
            const auto known = settled.find(wish.sensor);
            if (!wish.settled && known != settled.end() && known->second.config == sensor)
                wish.settled = known->second.choice;
            wishes.push_back(std::move(wish));
        }
    }
    SensorBackends backends = make_backends(wishes, loaded.scene);
    return {std::move(config), std::move(loaded), std::move(backends), std::move(notices)};
}

}  // namespace scipd::daemon
