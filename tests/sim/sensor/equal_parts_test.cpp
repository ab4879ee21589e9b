// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/equal_parts.h"

#include <chrono>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

using namespace std::chrono_literals;

TEST(EqualParts, HoldEveryBeamOnce) {
    for (const std::size_t count : {1U, 3U, 1080U, 1081U}) {
        std::size_t next = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const Beams part = equal_part(1081, i, count);
            ASSERT_EQ(part.first, next);
            ASSERT_GE(part.count, 1081 / count);
            ASSERT_LE(part.count, 1081 / count + 1);
            next += part.count;
        }
        EXPECT_EQ(next, 1081U);
    }
}

// The largest picture with a pose for each pixel.
TEST(EqualParts, AreAsManyAsPixels) {
    constexpr std::size_t pixels = 640 * 480;
    for (const std::size_t i : {std::size_t{0}, std::size_t{50'000}, pixels - 1}) {
        EXPECT_EQ(equal_part(pixels, i, pixels).first, i);
        EXPECT_EQ(equal_part(pixels, i, pixels).count, 1U);
    }
}

/// A sweep of 101 beams in 20 ms, from then on.
class Sweep20ms : public testing::Test {
  protected:
    std::vector<TimedBeams> parts(Time begin, std::size_t most = 101) const {
        const auto fired = [&](std::size_t beam) { return begin + beam * 200us; };
        return equal_parts(101, most, fired, movers_);
    }

    PoseTrack track_{Pose{}};
    std::vector<Mover> movers_{{0, std::sqrt(0.75), &track_}};  // a cube of 1 m
};

TEST_F(Sweep20ms, AreOneWhereNothingMoves) {
    track_.place(1s, pose_from_rpy({1, 0, 0}, {}));
    track_.place(1500ms, pose_from_rpy({2, 0, 0}, {}));
    const std::vector<TimedBeams> still = parts(2s);
    ASSERT_EQ(still.size(), 1U);
    EXPECT_EQ(still[0].beams.count, 101U);
    EXPECT_EQ(still[0].time, 2s + 10ms);
    movers_.clear();
    EXPECT_EQ(parts(1s).size(), 1U);
}

TEST_F(Sweep20ms, AreOneAMillimetre) {
    track_.place(1s, pose_from_rpy({1, 0, 0}, {}));
    track_.place(1500ms, pose_from_rpy({1.99, 0, 0}, {}));
    const std::vector<TimedBeams> moving = parts(1s);  // 39.6 mm
    EXPECT_EQ(moving.size(), 40U);
    EXPECT_EQ(moving[1].beams.first, 2U);
    EXPECT_EQ(moving[1].beams.count, 3U);
    EXPECT_EQ(moving[1].time, 1s + 3 * 200us);
    EXPECT_EQ(parts(1s, 7).size(), 7U);
}

// A corner is 0.87 m from the axis at most.
TEST_F(Sweep20ms, CountWhatATurnMoves) {
    track_.place(1s, Pose{});
    track_.place(1200ms, pose_from_rpy({}, {0, 0, 1.0}));
    EXPECT_EQ(parts(1s).size(), 87U);
}

TEST_F(Sweep20ms, CountTheWayToAndFro) {
    track_.place(1s, Pose{});
    for (int i = 1; i <= 10; ++i)
        track_.append(1s + i * 2ms, pose_from_rpy({i % 2 == 0 ? 0.0 : 0.00485, 0, 0}, {}));
    EXPECT_EQ(parts(1s).size(), 49U);
}

}  // namespace
}  // namespace scipd::sim
