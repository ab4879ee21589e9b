// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The smallest world for a scanner, and the turning of an io_context by hand.
#pragma once

#include <chrono>
#include <string>
#include <utility>

#include <boost/asio/io_context.hpp>

#include "daemon/config/config.h"
#include "daemon/models/model_registry.h"
#include "daemon/world/world.h"
#include "tests/support/one_backend.h"
#include "tests/support/scene_builder.h"

namespace scipd::daemon {

/// A wall from y = -5 to 5 whose face is 4 m ahead of the origin, where the robot "robot" is;
/// behind it a movable "model 1" of 1 m by 1 m.
inline World wall_world() {
    const sim::SharedScene scene =
        sim::SceneBuilder()
            .add(sim::Box{{1.0, 10.0, 10.0}}, sim::pose_from_rpy({4.5, 0, 0}, {0, 0, 0}))
            .movable(sim::pose_from_rpy({20, 0, 0}, {0, 0, 0}))
            .with(sim::Box{{1.0, 1.0, 1.0}}, {})
            .build();
    World world;
    world.replace_scene(scene, one_backend(scene));
    world.set_robots({{"robot", {}}});
    return world;
}

/// On the robot's origin, without noise, answering at once; its front step reads 4000.
inline SensorConfig ideal_sensor(const std::string& model = "UST-10LX") {
    SensorConfig config;
    config.name = "scanner";
    config.model = find_model(model);
    config.accuracy = sim::Accuracy::ideal;
    config.timing = Timing::ideal;
    return config;
}

/// Turns it until the condition holds; false: it does not within a time that is far longer than
/// anything takes on a busy machine.
template <class Condition>
bool run_until(boost::asio::io_context& io, Condition condition) {
    using namespace std::chrono_literals;
    const auto end = std::chrono::steady_clock::now() + 15s;
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        io.restart();
        io.run_one_for(10ms);
    }
    return true;
}

}  // namespace scipd::daemon
