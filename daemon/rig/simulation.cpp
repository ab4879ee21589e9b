// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/rig/simulation.h"

#include <variant>

#include <spdlog/spdlog.h>

#include "daemon/device/device.h"
#include "daemon/device/staring_sensor.h"
#include "daemon/plan/mounting.h"

namespace scipd::daemon {

Simulation::Simulation(const boost::asio::any_io_executor& executor, ClockKind kind,
                       std::size_t shard_count)
    : wall_clock(executor),
      lockstep(kind == ClockKind::poses ? std::make_unique<Lockstep>(executor) : nullptr),
      clock(lockstep ? static_cast<Clock&>(lockstep->clock()) : wall_clock),
      shards(lockstep ? Shards(executor, world, lockstep->clock(), shard_count)
                      : Shards(executor, world, wall_clock, shard_count)),
      editor(
          world, worker, clock, [this] { return requested_backends(); }, limits),
      chooser(world, worker, wall_clock, clients, [this] { return requested_backends(); }),
      stream(limits, ways()),
      view(ways(), wall_clock, limits),
      wire(ways()),
      recordings(ways(), clock, [this](Worker::Begin begin) { worker.add(std::move(begin)); }),
      worker(executor),
      drawer(executor, false) {
    stream.on_fault([this](const std::string& event) { view.tell_fault(event); });
    shards.on_changed([this](std::size_t shard) {
        for (const auto& station : stations) {
            if (station->shard == shard) station->loop->poses_came();
        }
    });
    shards.on_late([this](std::size_t shard) { tell_of_late(shard); });
    for (std::size_t shard = 0; shard < shards.size(); ++shard) {
        place_glances.push_back(
            std::make_unique<PlaceGlance>(shards.at(shard).world, [this](NewPlace place) {
                shards.call_home([this, place = std::move(place)]() mutable {
                    place_watch.look_at(std::move(place));
                });
            }));
    }
}

ScanStream::Ways Simulation::ways() {
    return {.to_sensors = [this](const auto& call) { shards.still(call); },
            .to_stream = [this](auto call) { shards.call_home(std::move(call)); }};
}

void Simulation::tell_of_late(std::size_t shard) const {
    std::string names;
    for (const auto& station : stations) {
        if (station->shard == shard) names += (names.empty() ? "" : ", ") + station->name();
    }
    spdlog::error("the thread of {} has not ended what it does for 2 s, and all else waits for it",
                  names.empty() ? "no sensor" : names);
}

std::vector<RequestedBackend> Simulation::requested_backends() const {
    const ClockKind kind = lockstep ? ClockKind::poses : ClockKind::wall;
    std::vector<RequestedBackend> requests;
    for (const auto& station : stations) {
        const sim::Pose pose = world.robot(station->robot)->at(clock.now());
        requests.push_back(requested_backend(station->robot, station->config, pose, kind,
                                             world.light().materials()));
        requests.back().shard = station->shard;
        requests.back().settled = world.choice_of(requests.back().sensor);
    }
    return requests;
}

void Simulation::choose_backends() {
    if (!lockstep) chooser.choose();
}

KnownSensors Simulation::known_sensors() {
    return shards.still([this] {
        KnownSensors known;
        for (const auto& station : stations) {
            const SensorCounts counts =
                std::visit([](const auto& sensor) { return sensor->counts(); }, station->sensor);
            known[station->name()] = {station->config, world.choice_of(station->name()),
                                      mean_cast(counts)};
        }
        return known;
    });
}

std::vector<ScenarioRun::Target> Simulation::scanners() {
    std::vector<ScenarioRun::Target> scanners;
    for (const auto& station : stations) {
        if (station->faults) scanners.push_back(target_of(*station));
    }
    return scanners;
}

ScenarioRun::Target Simulation::target_of(const Station& scanner) {
    return {scanner.name(), scanner.faults.get(),
            [this, shard = scanner.shard](const auto& act) { shards.still_on(shard, act); }};
}

std::vector<std::string> Simulation::remount() {
    std::vector<std::string> warnings;
    for (const auto& station : stations) {
        SensorConfig& sensor = station->config;
        if (!sensor.mount) continue;
        if (const auto pose = mounted_again(*sensor.mount, *world.scene())) {
            sensor.robot_from_sensor = *pose;
            shards.still([&] { station->mount(*pose); });
        } else {
            warnings.push_back(editor.file().string() + ": has no \"" + sensor.mount->name +
                               "\" in a model \"" + sensor.mount->model + "\" to mount " +
                               station->name() + " on; it stays where it was");
        }
    }
    return warnings;
}

}  // namespace scipd::daemon
