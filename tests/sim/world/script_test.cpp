// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/script.h"

#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

using namespace std::chrono_literals;

Pose on_x(double x_m) {
    return {{x_m, 0, 0}, {1, 0, 0, 0}};
}

/// 4 m in 2 s, a second's rest; again from the start after 5 s where it has laps.
Script walk(Time lap) {
    return {{{0s, on_x(0)}, {2s, on_x(4)}, {3s, on_x(4)}}, lap};
}

double x_m(const Script& script, Time begin, Time time) {
    return script.at(begin, time).translation_m.x;
}

TEST(Script, MovesEvenlyBetweenStepsAndStaysAtItsEnd) {
    const Script once = walk(0s);
    EXPECT_EQ(x_m(once, 10s, 9s), 0.0) << "before it began";
    EXPECT_DOUBLE_EQ(x_m(once, 10s, 10500ms), 1.0);
    EXPECT_DOUBLE_EQ(x_m(once, 10s, 12s), 4.0);
    EXPECT_DOUBLE_EQ(x_m(once, 10s, 1000s), 4.0);
}

TEST(Script, BeginsAnewAfterEachLap) {
    const Script rounds = walk(5s);
    for (const Time lap : {0s, 5s, 500s}) {
        EXPECT_DOUBLE_EQ(x_m(rounds, 10s, 10500ms + lap), 1.0);
        EXPECT_DOUBLE_EQ(x_m(rounds, 10s, 13s + lap), 4.0);
    }
}

TEST(Script, HasATrackThatIsRightThroughout) {
    const Script rounds = walk(5s);
    const PoseTrack track = rounds.between(10s, 11s, 21s);
    for (Time time = 11s; time <= 21s; time += 125ms)
        EXPECT_NEAR(track.at(time).translation_m.x, x_m(rounds, 10s, time), 1e-9) << time.count();
}

TEST(Script, GoesTheSameWayInAFrameThatLiesElsewhere) {
    const Script here = walk(5s);
    const auto there = moved({{1, 2, 0}, {1, 0, 0, 0}}, here);
    EXPECT_EQ(there->lap, here.lap);
    EXPECT_EQ(there->at(0s, 1s).translation_m, glm::dvec3(3, 2, 0));
}

}  // namespace
}  // namespace scipd::sim
