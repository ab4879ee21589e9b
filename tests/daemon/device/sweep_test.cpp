// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Sweeps of a scanner that moves, or past which things move, against closed form: what each beam
// meets from where the sensor is, and where everything else is, at its own instant.
#include "daemon/device/sweep.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/daemon/wall_world.h"
#include "tests/support/one_backend.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using Seconds = std::chrono::duration<double>;

constexpr double tolerance_m = 2e-3;
constexpr sim::Time period = 25ms;

double seconds(sim::Time time) {
    return Seconds(time).count();
}

/// A revolution that begins at 10 s.
sim::Time fired(int step) {
    return 10s + period * step / 1440;
}

World world_of(const sim::SceneBuilder& scene) {
    World world;
    const sim::SharedScene built = scene.build();
    world.replace_scene(built, one_backend(built, {"robot/scanner", "other/scanner"}));
    return world;
}

Sweep sweep_in(World& world, const SensorConfig& config) {
    return {world, "robot", config, sim::Scanner(config.model.optics, {sim::Accuracy::ideal})};
}

/// Within walls at x = -3 and 3, y = -2 and 2.
double range_in_room(double x_m, double y_m, double bearing_rad) {
    const double dx = std::cos(bearing_rad);
    const double dy = std::sin(bearing_rad);
    const double to_x = std::abs(dx) < 1e-12 ? 1e9 : ((dx > 0 ? 3.0 : -3.0) - x_m) / dx;
    const double to_y = std::abs(dy) < 1e-12 ? 1e9 : ((dy > 0 ? 2.0 : -2.0) - y_m) / dy;
    return std::min(to_x, to_y);
}

class TurningRobot : public testing::Test {
  protected:
    static constexpr double turn_radps = std::numbers::pi;

    static double yaw_at(sim::Time time) { return turn_radps * seconds(time - 10s); }

    TurningRobot() {
        world_.set_robots({{"robot", {}}});
        for (sim::Time time = 9s; time <= 11s; time += 10ms) {
            (void)world_.place_robot(
                "robot", {time, sim::pose_from_rpy({0.3, -0.2, 0}, {0, 0, yaw_at(time)})});
        }
    }

    World world_ = world_of(sim::SceneBuilder().add(sim::Box{{6, 4, 2}}, sim::Pose{}));
    SensorConfig config_ = ideal_sensor();
};

TEST_F(TurningRobot, SweepsEachBeamFromItsOwnPose) {
    const sim::SharedScan scan = sweep_in(world_, config_).measure(0, 10s, fired, {}).cast;
    for (int step = 0; step <= 1080; ++step) {
        const double bearing = config_.model.optics.angle_rad(step) + yaw_at(fired(step));
        ASSERT_NEAR(scan->readings[static_cast<std::size_t>(step)].range_m,
                    range_in_room(0.3, -0.2, bearing), tolerance_m)
            << step;
    }
}

// One pose, that of the middle of the sweep: the ends are off by 180 degrees a second for 9.4 ms.
TEST_F(TurningRobot, IsOffByWhatItTurnsWithOnePoseForAll) {
    config_.motion = 1;
    const sim::SharedScan scan = sweep_in(world_, config_).measure(0, 10s, fired, {}).cast;
    double worst_m = 0.0;
    for (int step = 0; step <= 1080; ++step) {
        const double angle = config_.model.optics.angle_rad(step);
        const double range_m = scan->readings[static_cast<std::size_t>(step)].range_m;
        ASSERT_NEAR(range_m, range_in_room(0.3, -0.2, angle + yaw_at(fired(540))), tolerance_m)
            << step;
        const double true_m = range_in_room(0.3, -0.2, angle + yaw_at(fired(step)));
        worst_m = std::max(worst_m, std::abs(range_m - true_m));
    }
    EXPECT_GT(worst_m, 0.05);
}

TEST_F(TurningRobot, MovesItsBodyOutOfItsOwnSightOnly) {
    world_ = world_of(sim::SceneBuilder()
                          .add(sim::Box{{6, 4, 2}}, sim::Pose{})
                          .movable({})
                          .with(sim::Box{{0.4, 0.4, 0.4}}, {}));
    world_.set_robots({{"robot", {.body = "model 1"}},
                       {"other", {.world_from_robot = sim::pose_from_rpy({-2, 0, 0}, {0, 0, 0})}}});
    (void)world_.place_robot("robot", {9s, sim::pose_from_rpy({1, 0, 0}, {0, 0, 0})});
    EXPECT_NEAR(sweep_in(world_, config_).measure(0, 10s, fired, {}).cast->readings[540].range_m,
                2.0, 1e-6);
    SensorConfig seeing = ideal_sensor();
    seeing.sees_body = true;
    EXPECT_NEAR(sweep_in(world_, seeing).measure(0, 10s, fired, {}).cast->readings[540].range_m,
                0.2, 1e-6);
    Sweep from_other(world_, "other", config_,
                     sim::Scanner(config_.model.optics, {sim::Accuracy::ideal}));
    EXPECT_NEAR(from_other.measure(0, 10s, fired, {}).cast->readings[540].range_m, 2.8, 1e-6);
}

// Its housing, 5 cm around it, is the scanner itself; the post on its left is not.
TEST_F(TurningRobot, SeesItsBodyButNotItsOwnHousing) {
    for (const bool movable : {true, false}) {
        sim::SceneBuilder scene;
        scene.add(sim::Box{{6, 4, 2}}, sim::Pose{});
        if (movable) scene.movable({}).with(sim::Cylinder{0.05, 0.1}, {});
        if (!movable) scene.add(sim::Cylinder{0.05, 0.1}, {});
        scene.with(sim::Box{{0.2, 0.2, 0.5}}, sim::pose_from_rpy({0, 0.6, 0}, {0, 0, 0}));
        world_ = world_of(scene);
        world_.set_robots({{"robot", {.body = movable ? "model 1" : ""}}});
        (void)world_.place_robot("robot", {9s, sim::Pose{}});
        for (const std::optional<int> motion : {std::optional<int>{}, std::optional{2}}) {
            SensorConfig seeing = ideal_sensor();
            seeing.sees_body = movable;
            seeing.motion = motion;
            if (!movable) seeing.mount = NamedMount{.model = "model 1"};
            const auto scan = sweep_in(world_, seeing).measure(0, 10s, fired, {}).cast;
            EXPECT_NEAR(scan->readings[540].range_m, 3.0, tolerance_m);
            EXPECT_NEAR(scan->readings[900].range_m, 0.5, tolerance_m);
            EXPECT_EQ(scan->hits[900].object, 2U);
        }
    }
}

TEST_F(TurningRobot, SeesNothingWhereItIsNowhere) {
    world_.set_robots({{"robot", {.policy = {.after = sim::PosePolicy::After::absent}}}});
    const sim::Time in_the_middle = fired(540);
    (void)world_.place_robot("robot", {in_the_middle - 500ms, sim::Pose{}});
    const sim::SharedScan scan = sweep_in(world_, config_).measure(0, 10s, fired, {}).cast;
    EXPECT_TRUE(scan->hits[540].met());
    EXPECT_FALSE(scan->hits[541].met());
    for (std::size_t beam = 0; beam < scan->hits.size(); ++beam)
        ASSERT_EQ(scan->hits[beam].met(), beam <= 540) << beam;
}

TEST_F(TurningRobot, SharesThePoseThatItHasNoMoreOrNotYet) {
    world_.set_robots({{"robot", {.policy = {.absent_before = true}}}});
    (void)world_.place_robot("robot", {fired(500), sim::Pose{}});
    config_.motion = 3;  // beams 0 to 359, 360 to 719, 720 to 1080, as the middle ones have it
    const sim::SharedScan scan = sweep_in(world_, config_).measure(0, 10s, fired, {}).cast;
    for (std::size_t beam = 0; beam < scan->hits.size(); ++beam)
        ASSERT_EQ(scan->hits[beam].met(), beam >= 360) << beam;
}

class Door : public testing::Test {
  protected:
    /// A door, 0.1 m thick and 1 m wide, in front of a far wall.
    World world_ = world_of(sim::SceneBuilder()
                                .add(sim::Box{{0.2, 40, 2}}, sim::pose_from_rpy({8, 0, 0}, {}))
                                .movable({})
                                .with(sim::Box{{0.1, 1.0, 2.0}}, {}));
    SensorConfig config_ = ideal_sensor();

    Door() { world_.set_robots({{"robot", {}}}); }

    /// From 10 s on at this velocity.
    void move_door(const glm::dvec3& from_m, const glm::dvec3& velocity_mps) {
        for (const sim::Time time : {9500ms, 10'000ms, 10'500ms}) {
            (void)world_.place_model(
                "model 1", {time, {from_m + velocity_mps * seconds(time - 10s), {1, 0, 0, 0}}});
        }
    }
};

TEST_F(Door, IsMetWhereItIsWhenTheBeamIsFired) {
    move_door({3, 0, 0}, {-4, 0, 0});
    const sim::SharedScan scan = sweep_in(world_, config_).measure(0, 10s, fired, {}).cast;
    int met = 0;
    for (int step = 0; step <= 1080; ++step) {
        const double angle = config_.model.optics.angle_rad(step);
        const double face_m = 3 - 0.05 - 4 * seconds(fired(step) - 10s);
        if (std::abs(angle) > 1.0 || std::abs(face_m * std::tan(angle)) > 0.49) continue;
        ++met;
        ASSERT_NEAR(scan->readings[static_cast<std::size_t>(step)].range_m,
                    face_m / std::cos(angle), tolerance_m)
            << step;
    }
    EXPECT_GT(met, 70);
}

/// Four times as long as a revolution of the scanner in the configuration.
sim::Time fired_slowly(int step) {
    return 10s + 4 * (fired(step) - 10s);
}

TEST_F(Door, IsMetWhereItVibratesTo) {
    const auto face_m = [](sim::Time time) {
        return 2.95 + 0.05 * std::sin(30 * 2 * std::numbers::pi * seconds(time - 10s));
    };
    for (sim::Time time = 9990ms; time <= 10'110ms; time += 1ms) {
        (void)world_.place_model("model 1",
                                 {time, sim::pose_from_rpy({face_m(time) + 0.05, 0, 0}, {})});
    }
    for (const bool in_equal_parts : {false, true}) {
        if (in_equal_parts) config_.motion = config_.model.optics.beams();
        const sim::SharedScan scan =
            sweep_in(world_, config_).measure(0, 10s, fired_slowly, {}).cast;
        int met = 0;
        for (int step = 360; step <= 720; ++step) {
            const double angle = config_.model.optics.angle_rad(step);
            const double ahead_m = face_m(fired_slowly(step));
            if (std::abs(ahead_m * std::tan(angle)) > 0.49) continue;
            ++met;
            ASSERT_NEAR(scan->readings[static_cast<std::size_t>(step)].range_m,
                        ahead_m / std::cos(angle), tolerance_m)
                << step << " " << in_equal_parts;
        }
        EXPECT_GT(met, 60);
    }
}

TEST_F(Door, IsMetAtOneInstantByBeamsThatShareAPose) {
    move_door({3, 0, 0}, {-4, 0, 0});
    config_.motion = 9;
    const sim::SharedScan scan = sweep_in(world_, config_).measure(0, 10s, fired, {}).cast;
    for (int step = 510; step <= 570; ++step) {
        // Beams 480 to 599, as if all were fired when the middle one is.
        const double face_m = 3 - 0.05 - 4 * seconds(fired(540) - 10s);
        ASSERT_NEAR(scan->readings[static_cast<std::size_t>(step)].range_m,
                    face_m / std::cos(config_.model.optics.angle_rad(step)), 1e-5)
            << step;
    }
}

TEST_F(Door, IsMetWhereItHasJumpedTo) {
    for (int step = 500; step < 580; step += 10) {
        const double x_m = step % 20 == 0 ? 3.05 : 2.05;
        (void)world_.place_model("model 1", {fired(step), sim::pose_from_rpy({x_m, 0, 0}, {})});
    }
    const sim::SharedScan scan = sweep_in(world_, config_).measure(0, 10s, fired, {}).cast;
    for (int step = 510; step < 580; ++step) {
        const double ahead_m = step / 10 % 2 == 0 ? 3.0 : 2.0;
        const double angle = config_.model.optics.angle_rad(step);
        ASSERT_NEAR(scan->readings[static_cast<std::size_t>(step)].range_m,
                    ahead_m / std::cos(angle), 1e-5)
            << step;
    }
}

TEST_F(Door, HasItsEdgesWhereTheyAreWhenTheBeamIsFired) {
    move_door({3, 0.2, 0}, {0, 6, 0});
    const sim::SharedScan scan = sweep_in(world_, config_).measure(0, 10s, fired, {}).cast;
    int met = 0;
    for (int step = 360; step <= 720; ++step) {
        const double y_m = 2.95 * std::tan(config_.model.optics.angle_rad(step));
        const double aside_m = y_m - (0.2 + 6 * seconds(fired(step) - 10s));
        if (std::abs(std::abs(aside_m) - 0.5) < tolerance_m) continue;
        const bool on_face = std::abs(aside_m) < 0.5;
        met += on_face ? 1 : 0;
        const sim::ObjectId object = scan->hits[static_cast<std::size_t>(step)].object;
        if (on_face) {
            ASSERT_EQ(object, 1U) << step;
        }
        // Beside the face there is its edge, seen from the side, and then the wall.
        if (std::abs(aside_m) > 0.52) {
            ASSERT_EQ(object, 0U) << step;
        }
    }
    EXPECT_GT(met, 60);
}

}  // namespace
}  // namespace scipd::daemon
