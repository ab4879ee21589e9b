// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/program/run_options.h"

#include <algorithm>

#include "sim/loaders/scene_file.h"

namespace scipd::daemon {
namespace {

/// The key of the configuration no longer says where the value is from.
void put_path(const std::filesystem::path& path, std::filesystem::path& into, const char* key,
              Config& read) {
    if (path.empty()) return;
    into = path;
    read.places.erase(key);
}

/// Clients may name files beside the world, where the configuration lets them do so.
void put_scene(const std::filesystem::path& scene, Config& read) {
    if (scene.empty()) return;
    if (!read.scene.empty()) {
        std::ranges::replace(read.allow, sim::folder_of_scene(read.scene),
                             sim::folder_of_scene(scene));
    }
    put_path(scene, read.scene, "scene", read);
}

void free_ports_of(Config& read) {
    for (RobotConfig& robot : read.robots) {
        for (SensorConfig& sensor : robot.sensors) {
            if (!sensor.tcp && !sensor.pty) continue;
            sensor.tcp = Address{"127.0.0.1", 0};
            sensor.pty.reset();
        }
    }
}

}  // namespace

void Overrides::put_into(Config& read) const {
    put_scene(scene, read);
    put_path(materials, read.materials, "materials", read);
    put_path(scenario, read.scenario, "scenario", read);
    put_path(control, read.control, "control", read);
    for (const auto& [name, value] : xacro)
        read.xacro.insert_or_assign(name, value);
    if (geometry) read.geometry = *geometry;
    if (clock) read.clock = *clock;
    if (seed) read.seed = *seed;
    if (http) read.http = *http;
    read.strict |= strict;
    if (free_ports) free_ports_of(read);
    if (broker.host.empty() && world.empty()) return;
    if (!read.fleet) read.fleet.emplace();
    if (!broker.host.empty()) read.fleet->broker = broker;
    if (!world.empty()) read.fleet->world = world;
}

}  // namespace scipd::daemon
