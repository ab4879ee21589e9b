// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A camera and a ranger 4 m before a wall, on a clock that is turned by hand: when they measure,
// from where, and for whom.
#include "daemon/device/staring_sensor.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "daemon/clock/stepped_clock.h"
#include "daemon/device/scan_loop.h"
#include "tests/daemon/device/ideal_camera.h"
#include "tests/daemon/wall_world.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

constexpr float nothing = std::numeric_limits<float>::infinity();

/// A row of three pixels: those at the sides look where y is 2/3 of x. Every 40 ms.
SensorConfig row_of_three() {
    return ideal_camera(3, 8.0);
}

World wall_before_sensors() {
    World world = wall_world();
    world.replace_backends(one_backend(world.scene(), {"robot/tof", "robot/other"}));
    return world;
}

class StaringSensorTest : public testing::Test {
  protected:
    void use(const SensorConfig& config) {
        loop_.reset();
        sensor_ = std::make_unique<StaringSensor>("robot", config, 1, world_, clock_);
        loop_ = std::make_unique<ScanLoop>(*sensor_, clock_);
    }
    void watch() {
        sensor_->watch([this](const StaringRecord& record) { seen_.push_back(record); });
    }
    void move_to(sim::Time time, double x_m) {
        ASSERT_TRUE(
            world_.place_robot("robot", {.time = time, .pose = {{x_m, 0, 0}, {1, 0, 0, 0}}}));
        loop_->poses_came();
    }
    [[nodiscard]] std::vector<std::int64_t> numbers() const {
        std::vector<std::int64_t> all;
        for (const StaringRecord& record : seen_)
            all.push_back(record.cast->revolution);
        return all;
    }
    /// What the middle pixel saw.
    [[nodiscard]] std::vector<float> ahead_m() const {
        std::vector<float> all;
        for (const StaringRecord& record : seen_)
            all.push_back(record.range_m[1]);
        return all;
    }

    SteppedClock clock_;
    World world_ = wall_before_sensors();
    std::unique_ptr<StaringSensor> sensor_;
    std::unique_ptr<ScanLoop> loop_;
    std::vector<StaringRecord> seen_;
};

TEST_F(StaringSensorTest, MeasuresAtEveryInstantWhileSomebodyWatches) {
    clock_.advance_to(7ms);
    use(row_of_three());
    clock_.advance_to(100ms);
    EXPECT_EQ(sensor_->measured(), 0U);
    watch();
    clock_.advance_to(206ms);
    // At 7, 47, 87, 127, 167 and 207 ms.
    EXPECT_EQ(numbers(), (std::vector<std::int64_t>{3, 4}));
    EXPECT_EQ(seen_[0].cast->start, 127ms);
    EXPECT_EQ(seen_[1].cast->start, 167ms);
    clock_.advance_to(207ms);
    EXPECT_EQ(numbers().back(), 5);
    const float aside_m = 4.0F * std::sqrt(1.0F + 4.0F / 9.0F);
    EXPECT_NEAR(seen_[0].range_m[0], aside_m, 1e-4);
    EXPECT_NEAR(seen_[0].range_m[1], 4.0, 1e-4);
    EXPECT_NEAR(seen_[0].range_m[2], aside_m, 1e-4);
    sensor_->watch(nullptr);
    clock_.advance_to(1s);
    EXPECT_EQ(seen_.size(), 3U);
    EXPECT_LE(sensor_->measured(), 4U);
}

TEST_F(StaringSensorTest, MeasuresTheLastInstantForWhoAsks) {
    use(row_of_three());
    move_to(100ms, 0.0);
    move_to(200ms, 1.0);
    clock_.advance_to(190ms);
    const SharedStaringRecord record = sensor_->latest();
    EXPECT_EQ(record->cast->revolution, 4);
    EXPECT_EQ(record->cast->start, 160ms);
    EXPECT_NEAR(record->range_m[1], 4.0 - 0.6, 1e-4);
    EXPECT_NEAR(record->cast->world_from_sensor.front().translation_m.x, 0.6, 1e-9);
    // Once for all who ask.
    clock_.advance_to(199ms);
    EXPECT_EQ(sensor_->latest(), record);
    EXPECT_EQ(sensor_->measured(), 1U);
    EXPECT_EQ(sensor_->log().find(4), record);
}

TEST_F(StaringSensorTest, TakesAPictureFromOnePoseOrRollsThroughThePeriod) {
    for (const bool rolling : {false, true}) {
        seen_.clear();
        clock_.advance_to(clock_.now() + 1s);
        SensorConfig config = row_of_three();
        if (rolling) config.motion.reset();
        use(config);
        const sim::Time start = clock_.now();
        for (const sim::Time time : {0ms, 120ms})
            move_to(start + time + 1ms, std::chrono::duration<double>(time).count());
        watch();
        clock_.advance_to(start + 80ms);
        // At 1 m/s the sensor is at 0.079 m at the instant, and at its thirds before.
        const auto& poses = seen_.back().cast->world_from_sensor;
        ASSERT_EQ(poses.size(), rolling ? 3U : 1U);
        EXPECT_NEAR(poses.back().translation_m.x, 0.079, 1e-6);
        EXPECT_NEAR(poses.front().translation_m.x, rolling ? 0.079 - 0.08 / 3 : 0.079, 1e-6);
    }
}

// More pixels than an int holds the square of.
TEST_F(StaringSensorTest, RollsThroughALargePicture) {
    SensorConfig config = row_of_three();
    config.motion.reset();
    config.staring->optics = sim::PinholeGrid{300, 200, 0.1, 0.1};
    use(config);
    for (const sim::Time time : {0ms, 120ms})
        move_to(time, std::chrono::duration<double>(time).count());
    clock_.advance_to(80ms);
    const auto& poses = sensor_->latest()->cast->world_from_sensor;
    ASSERT_EQ(poses.size(), 60'000U);
    // At 1 m/s, in the period of 40 ms before 80 ms.
    for (std::size_t i = 0; i < poses.size(); ++i)
        ASSERT_NEAR(poses[i].translation_m.x, 0.04 + 0.04 * double(i + 1) / 60'000.0, 1e-6) << i;
}

TEST_F(StaringSensorTest, SeesNothingWhereItIsNowhere) {
    world_.set_robots({{"robot", {.policy = {.absent_before = true}}}});
    use(row_of_three());
    clock_.advance_to(50ms);
    EXPECT_EQ(sensor_->latest()->range_m, std::vector<float>(3, nothing));
}

TEST_F(StaringSensorTest, DoesNotSeeTheBodyThatCarriesIt) {
    world_.set_robots({{"robot", {.body = "model 1"}}});
    use(row_of_three());
    EXPECT_NEAR(sensor_->latest()->range_m[1], 4.0, 1e-4);
    SensorConfig seeing = row_of_three();
    seeing.sees_body = true;
    use(seeing);
    EXPECT_NEAR(sensor_->latest()->range_m[1], 0.5, 1e-4);
}

TEST_F(StaringSensorTest, WaitsForPosesThatAreLate) {
    SensorConfig patient = row_of_three();
    patient.wait_for_poses = 30ms;
    use(patient);
    move_to(39ms, 0.0);
    watch();
    clock_.advance_to(50ms);
    EXPECT_EQ(seen_.size(), 0U);
    EXPECT_EQ(sensor_->latest()->cast->revolution, 0);
    move_to(41ms, 0.02);
    clock_.advance_to(50ms);
    ASSERT_EQ(numbers(), std::vector<std::int64_t>{1});
    EXPECT_NEAR(ahead_m().back(), 3.99, 1e-4);
    EXPECT_EQ(sensor_->latest()->cast->revolution, 1);
    // Until its patience is at its end.
    clock_.advance_to(111ms);
    EXPECT_EQ(numbers().back(), 2);
}

TEST_F(StaringSensorTest, HasTheSameNoiseInEveryRun) {
    SensorConfig noisy = row_of_three();
    noisy.accuracy = sim::Accuracy::sensor;
    noisy.staring->noise = {{0.0, 0.02, 0.0}};
    use(noisy);
    const std::vector<float> first = sensor_->latest()->range_m;
    use(noisy);
    EXPECT_EQ(sensor_->latest()->range_m, first);
    noisy.name = "other";
    use(noisy);
    EXPECT_NE(sensor_->latest()->range_m, first);
    EXPECT_NE(first[1], 4.0F);
    EXPECT_NEAR(first[1], 4.0F, 0.12);
}

TEST_F(StaringSensorTest, KeepsFewPicturesThatAreLarge) {
    SensorConfig large = row_of_three();
    large.staring->optics = sim::PinholeGrid{1000, 1000, 0.1, 0.1};
    use(large);
    sensor_->ask_log();
    for (int i = 0; i < 4; ++i) {
        clock_.advance_to(i * 40ms);
        (void)sensor_->latest();
    }
    EXPECT_EQ(sensor_->log().first(), 2);
    EXPECT_EQ(sensor_->log().last(), 3);
}

}  // namespace
}  // namespace scipd::daemon
