// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/depth_plan.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vector_relational.hpp>
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
    EXPECT_TRUE(plan.pictures().empty());
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

glm::ivec2 end_px(const PlannedView& view) {
    return view.corner_px + view.strip.size_px;
}

bool lie_apart(const PlannedView& a, const PlannedView& b) {
    return glm::any(glm::lessThanEqual(end_px(a), b.corner_px)) ||
           glm::any(glm::lessThanEqual(end_px(b), a.corner_px));
}

/// Each pixel of each picture belongs to one view at most, and every beam looks once.
void expect_in_place(const DepthPlan& plan, std::size_t beams) {
    std::size_t count = 0;
    std::vector<int> looks(beams);
    for (const PlannedPicture& picture : plan.pictures()) {
        EXPECT_EQ(picture.first_view, count);
        count += picture.view_count;
        const auto views = plan.views_of(picture);
        for (auto view = views.begin(); view != views.end(); ++view) {
            EXPECT_TRUE(glm::all(glm::greaterThanEqual(view->corner_px, glm::ivec2{0})));
            EXPECT_TRUE(glm::all(glm::lessThanEqual(end_px(*view), picture.size_px)));
            EXPECT_TRUE(std::all_of(views.begin(), view, [&](const PlannedView& other) {
                return lie_apart(other, *view);
            }));
            for (const Look& look : plan.looks_of(*view))
                ++looks[look.ray];
        }
    }
    EXPECT_EQ(count, plan.views().size());
    EXPECT_EQ(looks, std::vector<int>(beams, 1));
}

TEST(DepthPlan, PlacesViewsBesideEachOther) {
    const auto directions = sweep(600);
    std::vector<Pose> poses;
    for (int i = 0; i < 600; ++i)
        poses.push_back(at(i / 50));  // 12 runs
    const DepthPlan plan({directions, poses}, {});
    EXPECT_EQ(plan.pictures().size(), 1U);
    expect_in_place(plan, directions.size());
}

// What OpenGL can draw in one go has an end, 16 384 pixels at least.
TEST(DepthPlan, MakesSeveralPicturesOfWhatOneCannotHold) {
    std::vector<glm::vec3> directions;
    for (int row = 0; row < 72; ++row) {
        for (int column = 0; column < 88; ++column)
            directions.push_back(glm::normalize(
                glm::vec3{1.0F, 0.6F - 0.0136F * float(column), 0.5F - 0.0136F * float(row)}));
    }
    const std::vector<Pose> poses{at(0)};
    const DepthPlan plan({directions, poses},
                         {.oversample = 16.0, .widest_pass_rad = glm::radians(10.0)});
    EXPECT_GT(plan.pictures().size(), 1U);
    for (const PlannedPicture& picture : plan.pictures()) {
        EXPECT_LE(picture.size_px.x, 4096);
        EXPECT_LE(picture.size_px.y, 4096);
    }
    expect_in_place(plan, directions.size());
}

TEST(DepthPlan, LooksAtPixelsOfTheBeamsOwnView) {
    const auto directions = sweep(600);
    const std::vector<Pose> poses{at(0)};
    const DepthPlan plan({directions, poses}, {.oversample = 3.0});
    ASSERT_EQ(plan.pictures().size(), 1U);
    const int width_px = plan.pictures().front().size_px.x;
    for (const PlannedView& view : plan.views()) {
        for (const Look& look : plan.looks_of(view)) {
            const int row = static_cast<int>(look.pixel) / width_px;
            const int column = static_cast<int>(look.pixel) % width_px;
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
