// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/anchor.h"

#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/scene_builder.h"

namespace scipd::sim {
namespace {

Pose at(double x_m, double y_m, double z_m) {
    return {{x_m, y_m, z_m}, Pose{}.rotation};
}

/// Twelve crates in a hall of 40 m by 20 m.
SceneBuilder hall(const Pose& world_from_hall = {}) {
    SceneBuilder scene(world_from_hall);
    scene.add(Plane{{40, 20}}, {});
    for (int i = 0; i < 12; ++i)
        scene.add(Box{{1, 1, 1}}, at(3.0 * i - 18.0, i % 2 == 0 ? 8.0 : -8.0, 0.5));
    return scene;
}

TEST(AnchorOf, IsTheOriginOfAnEmptyScene) {
    EXPECT_EQ(anchor_of(Scene{}), glm::dvec3(0.0));
}

TEST(AnchorOf, LiesBetweenTheObjectsWhereverTheirModelsAre) {
    Scene scene;
    scene.models = {{"a", false, pose_from_rpy({10'000, 0, 0}, {0, 0, 0})},
                    {"b", true, pose_from_rpy({10'020, 40, 0}, {0, 0, std::numbers::pi / 2})}};
    scene.objects = {{"a::l::v", 0, {}, Box{{2, 2, 2}}, 0},
                     {"b::l::v", 1, pose_from_rpy({0, 0, 8}, {0, 0, 0}), Box{{6, 2, 2}}, 0}};
    // x from 9999 to 10021, y from -1 to 43, z from -1 to 9
    EXPECT_EQ(anchor_of(scene), glm::dvec3(10'010, 21, 4));
}

TEST(AnchorOf, IsNotDrawnOutByWhatLiesFarOff) {
    const glm::dvec3 alone = anchor_of(*hall().build());
    SceneBuilder scene = hall();
    scene.add(Box{{0.2, 0.3, 0.05}}, at(2, 1, 343'000));
    scene.add(Box{{1, 1, 1}}, at(0, 0, 10'000));
    scene.movable(at(-70'000, 3, 0)).with(Box{{1, 1, 1}}, {});
    EXPECT_EQ(anchor_of(*scene.build()), alone);
}

TEST(AnchorOf, GoesWithTheWorldThatLiesFarFromItsOrigin) {
    SceneBuilder scene = hall(at(400'000, 5'000'000, 200));
    scene.add(Box{{1, 1, 1}}, at(0, 0, 10'000));
    EXPECT_LT(glm::distance(anchor_of(*scene.build()), glm::dvec3(400'000, 5'000'000, 200)), 3.0);
}

TEST(AnchorOf, OfTwoThingsLiesWithTheOneNearTheOrigin) {
    for (const double far_m : {-343'000.0, 343'000.0}) {
        const Pose far = at(0, 0, far_m);
        const Pose here = at(5, 0, 0);
        EXPECT_EQ(anchor_of(*SceneBuilder().add(Sphere{1}, far).add(Sphere{1}, here).build()),
                  here.translation_m);
        EXPECT_EQ(anchor_of(*SceneBuilder().add(Sphere{1}, here).add(Sphere{1}, far).build()),
                  here.translation_m);
    }
}

TEST(AnchorOf, GroundPlanesCountOnlyWhereNothingElseIs) {
    const Plane ground{{1e5, 1e5}};
    const Pose there = at(700, 0, 0);
    EXPECT_EQ(anchor_of(*SceneBuilder().add(ground, there).build()), there.translation_m);
    const glm::dvec3 alone = anchor_of(*hall().build());
    EXPECT_EQ(anchor_of(*hall().add(ground, there).build()), alone);
    // Nor do many of them outvote the hall.
    SceneBuilder scene = hall(at(400'000, 0, 0));
    for (int i = 0; i < 20; ++i)
        scene.add(Plane{{10, 10}}, at(-400'000, 10.0 * i, 0));
    EXPECT_LT(glm::distance(anchor_of(*scene.build()), alone + glm::dvec3(400'000, 0, 0)), 2.0);
}

TEST(Coarsest, TellsWhatLiesFarthestAndWhatItCosts) {
    EXPECT_FALSE(coarsest(*hall().build()));
    EXPECT_FALSE(coarsest(Scene{}));
    SceneBuilder scene = hall();
    scene.add(Box{{1, 1, 1}}, at(0, 0, 10'000));
    scene.add(Box{{1, 1, 1}}, at(0, 0, 3'000));
    const auto worst = coarsest(*scene.build());
    ASSERT_TRUE(worst);
    EXPECT_EQ(worst->object, 13U);
    EXPECT_NEAR(worst->distance_m, 10'000, 1);
    EXPECT_DOUBLE_EQ(worst->error_m, 1.0 / 1024);  // 2^13 / 2^23
}

TEST(Coarsest, LeavesOutGroundPlanesWhichAreExactAtAnyDistance) {
    EXPECT_FALSE(coarsest(*hall().add(Plane{{1e5, 1e5}}, {}).build()));
}

}  // namespace
}  // namespace scipd::sim
