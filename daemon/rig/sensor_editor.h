// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Lets sensors come and go while all others run, in the world as people have made it. Unlike a
// reload (server.h) it reads neither the configuration nor the world again. On the I/O thread; the
// plan is made on the worker's.
#pragma once

#include <functional>
#include <stop_token>
#include <string>
#include <utility>

#include "daemon/config/added_sensor.h"
#include "daemon/config/config.h"
#include "daemon/plan/rig_plan.h"
#include "daemon/world/scene_edit.h"

namespace scipd::daemon {

class Rig;

class SensorEditor {
  public:
    /// Makes it run, or throws std::runtime_error and changes nothing.
    using TakeUp = std::function<void(RigPlan&& plan)>;

    /// `rig` and `running`, the configuration of it, must outlive this.
    SensorEditor(Rig& rig, const Config& running, TakeUp take_up)
        : rig_(rig), running_(running), take_up_(std::move(take_up)) {}

    /// Each after all changes that were asked for before. `done` is called when the sensor is
    /// there, or gone, or why not; it is not called where this is withdrawn before it has begun.
    void add(AddedSensor sensor, EditDone done, std::stop_token withdrawn);
    void remove(const std::string& robot, const std::string& sensor, EditDone done,
                std::stop_token withdrawn);

  private:
    /// Makes of the configuration that runs the one that is wanted.
    using Change = std::function<Config(const Config& now)>;

    [[nodiscard]] bool is_there(const std::string& robot, const std::string& sensor) const;
    [[nodiscard]] Config now() const;
    [[nodiscard]] Running running() const;
    /// `refuse` tells what stands against it when its turn has come.
    void change(std::function<EditOutcome()> refuse, Change change, EditDone done,
                std::stop_token withdrawn);
    [[nodiscard]] EditOutcome take_up(RigPlan& plan) const;

    Rig& rig_;
    const Config& running_;
    const TakeUp take_up_;
};

}  // namespace scipd::daemon
