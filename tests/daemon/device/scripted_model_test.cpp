// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A person who walks by a script past a scanner, against closed form: whole sweeps, each beam at
// its own instant; and whoever moves the person ends the walk.
#include <chrono>
#include <cmath>
#include <memory>
#include <stdexcept>

#include <gtest/gtest.h>

#include "daemon/device/sweep.h"
#include "sim/backends/registry.h"
#include "sim/sensor/beam_pattern.h"
#include "sim/world/script.h"
#include "tests/daemon/wall_world.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

constexpr double tolerance_m = 2e-3;

double seconds(sim::Time time) {
    return std::chrono::duration<double>(time).count();
}

sim::Pose at_x(double x_m) {
    return {{x_m, 0, 0}, {1, 0, 0, 0}};
}

/// At 1 m/s away from x = 2 until x = 8, then anew.
sim::Script walk_away() {
    return {{{0s, at_x(2)}, {6s - 1ns, at_x(8)}}, 6s};
}

sim::SharedScene scene_with(const sim::Script& script) {
    // 1 m wide, 0.2 m thick; the wall's face is at x = 20.
    auto scene = std::make_shared<sim::Scene>(
        *sim::SceneBuilder()
             .add(sim::Box{{1, 400, 10}}, sim::pose_from_rpy({20.5, 0, 0}, {}))
             .movable(script.steps.front().pose)
             .with(sim::Box{{0.2, 1.0, 1.75}}, {})
             .build());
    scene->models[1].script = std::make_shared<const sim::Script>(script);
    return scene;
}

SensorBackends backends_for(const sim::SharedScene& scene, const std::string& backend) {
    const sim::BeamPattern pattern(ideal_sensor("UST-20LX").model.optics);
    const std::vector<RequestedBackend> requests{
        {.sensor = "robot/scanner",
         .backend = backend,
         .directions = {pattern.directions().begin(), pattern.directions().end()},
         .max_range_m = 30}};
    return make_backends(requests, scene);
}

/// Where the model "model 1" was at that time.
double x_m(const World& world, sim::Time time) {
    return world.model_pose("model 1", time)->translation_m.x;
}

class ScriptedModel : public testing::TestWithParam<std::string> {
  protected:
    void SetUp() override {
        try {
            put_in(scene_);
        } catch (const std::runtime_error& error) {
            GTEST_SKIP() << error.what();  // this machine cannot draw, say
        }
        world_.set_robots({{"robot", {}}});
    }

    void put_in(const sim::SharedScene& scene, const std::set<std::string>& anew = {},
                sim::Time now = {}) {
        world_.replace_scene(scene, backends_for(scene, GetParam()), anew, now);
    }

    /// One that begins then and takes 25 ms.
    sim::SharedScan sweep(sim::Time begin) {
        const auto fired = [&](int step) { return begin + 25ms * step / 1440; };
        return Sweep(world_, "robot", config_,
                     sim::Scanner(config_.model.optics, {sim::Accuracy::ideal}))
            .measure(0, begin, fired, {})
            .cast;
    }

    [[nodiscard]] double ahead_m(sim::Time begin) { return sweep(begin)->readings[540].range_m; }

    sim::SharedScene scene_ = scene_with(walk_away());
    World world_;
    SensorConfig config_ = ideal_sensor("UST-20LX");
};

TEST_P(ScriptedModel, IsMetWhereItIsWhenTheBeamIsFired) {
    for (const sim::Time begin : {0ms, 1000ms, 2345ms, 5900ms, 6000ms, 8345ms, 600'001'000ms}) {
        const sim::SharedScan scan = sweep(begin);
        int met = 0;
        for (int step = 360; step <= 720; ++step) {
            const double angle = config_.model.optics.angle_rad(step);
            const double since_s = seconds((begin + 25ms * step / 1440) % 6s);
            const double face_m = 2.0 + since_s - 0.1;
            if (std::abs(face_m * std::tan(angle)) > 0.49) continue;
            ++met;
            ASSERT_NEAR(scan->readings[static_cast<std::size_t>(step)].range_m,
                        face_m / std::cos(angle), tolerance_m)
                << step << " of " << seconds(begin);
        }
        EXPECT_GT(met, 20);
    }
}

// Two scanners ask at different times of one world, and late ones for what was.
TEST_P(ScriptedModel, IsWhereItWasForWhoeverAsksLater) {
    const double before = ahead_m(1s);
    EXPECT_NEAR(ahead_m(4s) - before, 3.0, 1e-3);
    EXPECT_EQ(ahead_m(1s), before);
}

TEST_P(ScriptedModel, IsWaitedForByNobody) {
    EXPECT_TRUE(world_.poses_known(1s));
    (void)sweep(1s);
    EXPECT_TRUE(world_.poses_known(1100ms));
    EXPECT_TRUE(world_.poses_known(100s));
}

TEST_P(ScriptedModel, WalksNoMoreOnceSomebodyHasMovedIt) {
    (void)sweep(1s);
    EXPECT_TRUE(world_.place_model("model 1", {3s, at_x(12)}));
    EXPECT_NEAR(ahead_m(1s), 2.9, 0.02) << "what it did before stays";
    EXPECT_NEAR(x_m(world_, 3s - 1ns), 5.0, 1e-6);
    EXPECT_DOUBLE_EQ(x_m(world_, 3s), 12.0);
    EXPECT_NEAR(ahead_m(4s), 11.9, 1e-3);
    EXPECT_NEAR(ahead_m(100s), 11.9, 1e-3);
    EXPECT_TRUE(world_.place_model("model 1", {100s, at_x(4)}));
    EXPECT_NEAR(ahead_m(101s), 3.9, 1e-3);
}

TEST_P(ScriptedModel, GoesOnWhereItsSceneIsReplacedByTheSameAndBeginsAnewInAnother) {
    put_in(scene_with(walk_away()), {}, 3s);
    EXPECT_NEAR(x_m(world_, 4s), 6.0, 1e-6);
    sim::Script faster = walk_away();
    faster.steps.back().pose = at_x(14);
    put_in(scene_with(faster), {}, 5s);
    EXPECT_NEAR(x_m(world_, 6s), 4.0, 1e-6);
    put_in(scene_with(faster), {"model 1"}, 8s);
    EXPECT_NEAR(x_m(world_, 9s), 4.0, 1e-6);
    // Whoever has moved it is not forgotten, unless it is placed anew.
    EXPECT_TRUE(world_.place_model("model 1", {10s, at_x(12)}));
    put_in(scene_with(faster), {}, 11s);
    EXPECT_DOUBLE_EQ(x_m(world_, 12s), 12.0);
    put_in(scene_with(faster), {"model 1"}, 13s);
    EXPECT_DOUBLE_EQ(x_m(world_, 13s), 2.0);
}

TEST_P(ScriptedModel, MovesWithTheRobotWhoseBodyItIs) {
    world_.set_robots({{"robot", {.world_from_robot = at_x(-5), .body = "model 1"}}});
    EXPECT_DOUBLE_EQ(x_m(world_, 3s), -5.0);
    world_.set_robots({{"robot", {.world_from_robot = at_x(-5)}}});
    EXPECT_NEAR(x_m(world_, 3s), 5.0, 1e-6);
}

std::vector<std::string> every_backend() {
    std::vector<std::string> names;
    for (const sim::BackendRow& backend : sim::backends())
        names.emplace_back(backend.name);
    return names;
}

INSTANTIATE_TEST_SUITE_P(Backends, ScriptedModel, testing::ValuesIn(every_backend()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace scipd::daemon
