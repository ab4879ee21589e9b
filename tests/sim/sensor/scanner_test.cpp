// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The scanner alone: the backend is a fake that remembers what it was asked and answers by formula.
#include "sim/sensor/scanner.h"

#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

using namespace std::chrono_literals;

/// The wall x = 3 of S, whatever the pose: 3 m straight ahead.
class WallAhead final : public RangeBackend {
  public:
    WallAhead()
        : RangeBackend(std::make_shared<const Scene>(Scene{.objects = std::vector<Object>(7)})) {}

    std::vector<Pose> asked_poses;
    float asked_max_range_m = 0.0F;

  private:
    void do_move(ModelId, const Pose&) override {}
    void do_cast(const Fan& fan, std::span<Hit> hits) override {
        asked_poses.assign(fan.world_from_sensor.begin(), fan.world_from_sensor.end());
        asked_max_range_m = fan.max_range_m;
        for (std::size_t i = 0; i < hits.size(); ++i) {
            const glm::vec3& direction = fan.directions[i];
            hits[i] = direction.x > 0.1F ? Hit{3.0F / direction.x, direction.x, 5, 6} : Hit{};
        }
    }
};

SensorSpec spec() {
    return {.steps_per_turn = 1440,
            .first_step = 100,
            .last_step = 980,
            .front_step = 540,
            .scan_period = 25ms,
            .max_range_m = 30.0,
            .noise = {{0.0, 0.01, 0.0}}};
}

TEST(Scanner, MeasuresEveryBeamInStepOrder) {
    WallAhead wall;
    const Scanner scanner(spec(), {.accuracy = Accuracy::ideal});
    const SharedScan scan = scanner.measure(wall, 0, 0s, {Pose{}});
    ASSERT_EQ(scan->readings.size(), 881U);
    ASSERT_EQ(scan->hits.size(), 881U);
    EXPECT_FLOAT_EQ(scan->readings[440].range_m, 3.0F);
    EXPECT_NEAR(scan->readings[440 + 240].range_m, 6.0F, 1e-5);  // 60 degrees to the left
    EXPECT_NEAR(scan->readings[440 - 240].range_m, 6.0F, 1e-5);
    EXPECT_EQ(scan->hits[440].material, 5U);
    EXPECT_EQ(scan->hits[440].object, 6U);
    EXPECT_FALSE(scan->hits[0].met());
}

TEST(Scanner, SaysWhatWhenAndFromWhere) {
    WallAhead wall;
    const Scanner scanner(spec(), {});
    const Pose pose = pose_from_rpy({1, 2, 3}, {0, 0, 1});
    const SharedScan scan = scanner.measure(wall, 17, 425ms, {pose});
    EXPECT_EQ(scan->revolution, 17);
    EXPECT_EQ(scan->start, 425ms);
    EXPECT_EQ(scan->world_from_sensor, std::vector<Pose>{pose});
    EXPECT_EQ(wall.asked_poses, std::vector<Pose>{pose});
    EXPECT_EQ(wall.asked_max_range_m, 30.0F);
}

TEST(Scanner, HandsOnAPoseForEachBeam) {
    WallAhead wall;
    const Scanner scanner(spec(), {});
    std::vector<Pose> poses(881);
    for (std::size_t i = 0; i < poses.size(); ++i)
        poses[i].translation_m.y = double(i);
    EXPECT_EQ(scanner.measure(wall, 0, 0s, poses)->world_from_sensor, poses);
    EXPECT_EQ(wall.asked_poses, poses);
}

TEST(Scanner, ReadsTheTruthWithNoiseThatDependsOnTheRevolutionOnly) {
    WallAhead wall;
    const Scanner scanner(spec(), {Accuracy::sensor, 1, 2});
    const SharedScan first = scanner.measure(wall, 1, 0s, {Pose{}});
    const SharedScan second = scanner.measure(wall, 2, 0s, {Pose{}});
    const SharedScan again = scanner.measure(wall, 1, 99s, {Pose{}});
    EXPECT_NE(first->readings, second->readings);
    EXPECT_EQ(first->readings, again->readings);
    EXPECT_FLOAT_EQ(first->hits[440].range_m, 3.0F);
    EXPECT_NE(first->readings[440].range_m, 3.0F);
    EXPECT_NEAR(first->readings[440].range_m, 3.0F, 0.06);
}

}  // namespace
}  // namespace scipd::sim
