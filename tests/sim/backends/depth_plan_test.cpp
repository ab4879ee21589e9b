// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/depth_plan.h"

#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

std::vector<glm::vec3> sweep(int beams) {
    std::vector<glm::vec3> directions;
    for (int i = 0; i < beams; ++i)
        directions.emplace_back(std::cos(0.01 * i), std::sin(0.01 * i), 0.0);
    return directions;
}

Pose at(double x) {
    return {{x, 0, 0}, Pose{}.rotation};
}

TEST(DepthPlan, OfNothingHasNoViews) {
    const DepthPlan plan({}, {});
    EXPECT_TRUE(plan.views().empty());
    EXPECT_EQ(plan.size_px(), (glm::ivec2{0, 0}));
}

TEST(DepthPlan, DrawsEachRunOfEqualPosesByItself) {
    const auto directions = sweep(10);
    std::vector<Pose> poses(10, at(0));
    std::fill(poses.begin() + 4, poses.begin() + 7, at(1));
    std::fill(poses.begin() + 7, poses.end(), at(0));  // again, and yet another run
    const DepthPlan plan({directions, poses}, {});
    ASSERT_EQ(plan.views().size(), 3U);
    const std::vector<std::pair<std::size_t, std::size_t>> pose_and_beams{{0, 4}, {4, 3}, {7, 3}};
    for (std::size_t i = 0; i < 3; ++i) {
        const PlannedView& view = plan.views()[i];
        EXPECT_EQ(view.pose, pose_and_beams[i].first);
        EXPECT_EQ(plan.looks_of(view).size(), pose_and_beams[i].second);
        for (const Look& look : plan.looks_of(view)) {
            EXPECT_GE(look.ray, view.pose);
            EXPECT_LT(look.ray, view.pose + pose_and_beams[i].second);
        }
    }
}

TEST(DepthPlan, PlacesViewsBesideEachOther) {
    const auto directions = sweep(600);
    std::vector<Pose> poses;
    for (int i = 0; i < 600; ++i)
        poses.push_back(at(i / 50));  // 12 runs
    const DepthPlan plan({directions, poses}, {});
    std::set<std::pair<int, int>> pixels;
    std::size_t drawn = 0;
    for (const PlannedView& view : plan.views()) {
        for (int y = 0; y < view.strip.size_px.y; ++y) {
            for (int x = 0; x < view.strip.size_px.x; ++x) {
                pixels.emplace(view.corner_px.x + x, view.corner_px.y + y);
                ++drawn;
                EXPECT_LT(view.corner_px.x + x, plan.size_px().x);
                EXPECT_LT(view.corner_px.y + y, plan.size_px().y);
            }
        }
    }
    EXPECT_EQ(pixels.size(), drawn);
}

TEST(DepthPlan, LooksAtPixelsOfTheBeamsOwnView) {
    const auto directions = sweep(600);
    const std::vector<Pose> poses{at(0)};
    const DepthPlan plan({directions, poses}, {.oversample = 3.0});
    for (const PlannedView& view : plan.views()) {
        for (const Look& look : plan.looks_of(view)) {
            const int row = static_cast<int>(look.pixel) / plan.size_px().x;
            const int column = static_cast<int>(look.pixel) % plan.size_px().x;
            const glm::dvec2 pixel = pixel_of(view.strip, glm::dvec3{directions[look.ray]});
            EXPECT_NEAR(column - view.corner_px.x + double{look.share.x}, pixel.x, 2e-3);
            EXPECT_EQ(row, view.corner_px.y);
            // The next pixel is looked at too, so it must be there.
            const int next = look.share.x > 0.0F ? 1 : 0;
            EXPECT_LT(column + next, view.corner_px.x + view.strip.size_px.x);
        }
    }
}

TEST(DepthPlan, FitsTheSameDirectionsWithTheSameChangesOfPose) {
    const auto directions = sweep(10);
    const std::vector<Pose> here{at(0)};
    const std::vector<Pose> there{at(9)};
    const DepthPlan plan({directions, here}, {});
    EXPECT_TRUE(plan.fits({directions, there}));
    EXPECT_TRUE(plan.fits({directions, std::vector<Pose>(10, at(2))}));
    std::vector<Pose> moving(10, at(0));
    moving[5] = at(1);
    EXPECT_FALSE(plan.fits({directions, moving}));
    auto others = directions;
    others[3].z = 0.1F;
    EXPECT_FALSE(plan.fits({others, here}));
    EXPECT_FALSE(plan.fits({sweep(9), here}));
    EXPECT_FALSE(plan.fits({}));
}

}  // namespace
}  // namespace scipd::sim
