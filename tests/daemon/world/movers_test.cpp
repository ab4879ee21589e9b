// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/world/movers.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "daemon/world/world.h"
#include "tests/support/one_backend.h"
#include "tests/support/scene_builder.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

constexpr int models = 20;
const double box_radius_m = std::sqrt(3.0) / 2.0;

/// Models of a box each that move about, drive long ways, and jump, and a robot that carries one.
class MoversTest : public testing::TestWithParam<unsigned> {
  protected:
    MoversTest() {
        sim::SceneBuilder scene;
        for (int i = 0; i < models; ++i)
            scene.movable(anywhere(30.0)).with(sim::Box{{1, 1, 1}}, {});
        scene_ = scene.build();
        world_.replace_scene(scene_, one_backend(scene_));
        RobotStart start;
        start.body = scene_->models.back().name;
        start.policy.after = GetParam() % 2 == 0 ? sim::PosePolicy::After::hold
                                                 : sim::PosePolicy::After::extrapolate;
        world_.set_robots({{"robot", start}});
    }

    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(rng_);
    }
    sim::Pose anywhere(double reach_m) {
        return sim::pose_from_rpy({uniform(-reach_m, reach_m), uniform(-reach_m, reach_m), 0.0},
                                  {0, 0, uniform(-3, 3)});
    }
    /// A little step, a long one, a jump, or a jump that takes back what was said of later times.
    void step(int model, sim::Time time) {
        const std::string& name = scene_->models[static_cast<std::size_t>(model)].name;
        const double reach_m = uniform(0, 1) < 0.8 ? 0.3 : 30.0;
        Placement placement{time, anywhere(reach_m)};
        placement.from_now_on = uniform(0, 1) < 0.1;
        if (placement.from_now_on) placement.time -= 70ms;
        if (reach_m < 1.0) placement.pose.translation_m += world_.model(name)->last().translation_m;
        const bool carried = model == models - 1;
        (void)(carried ? world_.place_robot("robot", placement)
                       : world_.place_model(name, placement));
    }
    /// Those that were left out, and are near at some moment.
    int missing(const Ball& ball, sim::Time from, sim::Time to) {
        const auto near = world_.movers().within(ball, from, to, sim::no_model);
        left_out_ += models - static_cast<int>(near.size());
        int missing = 0;
        for (const sim::Mover& mover : world_.movers().all(from, to, sim::no_model)) {
            if (std::ranges::count(near, mover.id, &sim::Mover::id) > 0) continue;
            for (sim::Time time = from; time <= to; time += 1ms) {
                const glm::dvec3 at_m = mover.path->at(time).translation_m;
                missing += glm::distance(at_m, ball.middle_m) < ball.radius_m + box_radius_m;
            }
        }
        return missing;
    }

    std::mt19937 rng_{GetParam()};
    sim::SharedScene scene_;
    World world_;
    int left_out_ = 0;
};

TEST_P(MoversTest, LeaveOutNoneThatIsNear) {
    for (sim::Time now = 1s; now < 6s; now += 50ms) {
        for (int model = 0; model < models; ++model) {
            if (uniform(0, 1) < 0.5) step(model, now);
        }
        const Ball ball{anywhere(30.0).translation_m, uniform(1, 15)};
        // A sweep that has just ended, or one that has waited for its poses.
        for (const sim::Time age : {0ms, 30ms, 400ms})
            EXPECT_EQ(missing(ball, now - age - 25ms, now - age), 0) << now.count();
    }
    // Most of them are far away, and most of these are known to be.
    EXPECT_GT(left_out_, 100 * 3 * models / 4);
}

TEST_P(MoversTest, TellTheOneThatIsNotSeen) {
    const Ball all{{}, 1000.0};
    EXPECT_EQ(world_.movers().within(all, 0s, 1s, sim::no_model).size(), models);
    const auto others = world_.movers().within(all, 0s, 1s, 3);
    EXPECT_EQ(others.size(), models - 1);
    EXPECT_EQ(std::ranges::count(others, 3U, &sim::Mover::id), 0);
}

INSTANTIATE_TEST_SUITE_P(Many, MoversTest, testing::Range(0U, 20U));

}  // namespace
}  // namespace scipd::daemon
