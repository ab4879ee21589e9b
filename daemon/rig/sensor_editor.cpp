// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/rig/sensor_editor.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <memory>
#include <stdexcept>

#include "daemon/rig/rig.h"
#include "daemon/rig/simulation.h"
#include "sim/loaders/file/load_error.h"

namespace scipd::daemon {

using Result = EditOutcome::Result;

void SensorEditor::add(AddedSensor sensor, EditDone done, std::stop_token withdrawn) {
    const auto refuse = [this, sensor]() -> EditOutcome {
        if (is_there(sensor.robot, sensor.name)) {
            return {Result::taken,
                    {"there is a sensor \"" + sensor_name(sensor.robot, sensor.name) +
                     "\" already; take another name, or DELETE it first"}};
        }
        const bool carried = std::ranges::any_of(
            running_.robots, [&](const auto& robot) { return robot.name == sensor.robot; });
        if (carried && sensor.robot_pose) {
            return {Result::taken,
                    {"there is a robot \"" + sensor.robot +
                     "\" already; leave pose out, and PUT /robots/" + sensor.robot + "/pose"}};
        }
        if (running_.scene.empty()) {
            return {Result::taken,
                    {"there is no world to look at: scipd plays recordings; start it with --scene "
                     "or with scene in the configuration"}};
        }
        return {};
    };
    change(
        refuse, [sensor](const Config& now) { return with_sensor(now, sensor); }, std::move(done),
        std::move(withdrawn));
}

void SensorEditor::remove(const std::string& robot, const std::string& sensor, EditDone done,
                          std::stop_token withdrawn) {
    const auto refuse = [this, robot, sensor]() -> EditOutcome {
        if (!is_there(robot, sensor)) return {Result::unknown, {}};
        if (rig_.simulation().stations.size() == 1)
            return {Result::taken, {"it is the only sensor, and scipd needs one"}};
        return {};
    };
    change(
        refuse, [robot, sensor](const Config& now) { return without_sensor(now, robot, sensor); },
        std::move(done), std::move(withdrawn));
}

bool SensorEditor::is_there(const std::string& robot, const std::string& sensor) const {
    return find_station(rig_.simulation().stations, sensor_name(robot, sensor)) != nullptr;
}

// With how scanners read now, and where they sit: as they are known to the plan.
Config SensorEditor::now() const {
    Config now = running_;
    for (RobotConfig& robot : now.robots) {
        for (SensorConfig& sensor : robot.sensors) {
            const std::string name = sensor_name(robot.name, sensor.name);
            sensor = find_station(rig_.simulation().stations, name)->config;
        }
    }
    return now;
}

Running SensorEditor::running() const {
    Running running = rig_.running();
    const World& world = rig_.simulation().world;
    running.world = KeptWorld{world.scene(), world.light().materials()};
    return running;
}

void SensorEditor::change(std::function<EditOutcome()> refuse, Change change, EditDone done,
                          std::stop_token withdrawn) {
    Worker& worker = rig_.simulation().worker;
    auto begin = [this, refuse = std::move(refuse), change = std::move(change),
                  done = std::move(done), stop = worker.stopping()]() -> Worker::Work {
        EditOutcome refusal = refuse();
        const bool refused = refusal.result != Result::done;
        // `done` belongs to the I/O thread, and is moved back there.
        return [this, change, done, stop, refused, refusal = std::move(refusal), now = now(),
                running = running()]() mutable -> Worker::Finish {
            const auto tell = [&](EditOutcome outcome) -> Worker::Finish {
                return [done = std::move(done), outcome = std::move(outcome)] { done(outcome); };
            };
            if (refused) return tell(std::move(refusal));
            try {
                const auto plan = std::make_shared<RigPlan>(make_plan(change(now), running, stop));
                return [this, plan, done = std::move(done)] { done(take_up(*plan)); };
            } catch (const sim::LoadError& error) {
                return tell({Result::faulty, error.faults()});
            } catch (const std::exception& error) {
                return tell({Result::faulty, {error.what()}});
            }
        };
    };
    worker.add(std::move(begin), std::move(withdrawn));
}

EditOutcome SensorEditor::take_up(RigPlan& plan) const {
    const std::vector<std::string> told = rig_.simulation().editor.warnings();
    EditOutcome outcome{.notes = plan.notices};
    std::ranges::copy_if(
        plan.loaded.warnings, std::back_inserter(outcome.messages),
        [&](const std::string& each) { return std::ranges::find(told, each) == told.end(); });
    try {
        take_up_(std::move(plan));
    } catch (const std::runtime_error& error) {  // another program has its port, say
        return {Result::taken, {error.what()}};
    }
    return outcome;
}

}  // namespace scipd::daemon
