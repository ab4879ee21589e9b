// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Every backend against the oracle, in cluttered worlds that nobody thought up.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sim/backends/registry.h"
#include "tests/sim/backends/contract.h"
#include "tests/sim/backends/convex_shapes.h"

namespace scipd::sim {
namespace {

constexpr std::size_t beams = 361;

SceneBuilder clutter(Rng& rng) {
    SceneBuilder scene(
        pose_from_rpy({400'000, 5'000'000, 200}, {0, 0, 0}));  // UTM coordinates, say
    scene.add(Plane{{60, 60}}, {{0, 0, -2}, Pose{}.rotation}, 1);
    MaterialId material = 2;
    for (int i = 0; i < 12; ++i) {
        for (const ConvexShape& shape : convex_shapes()) {
            const double reach_m = uniform(rng, 2.0, 15.0);
            if (i % 3 == 0) {
                scene.movable(random_pose(rng, reach_m))
                    .with(shape.shape, random_pose(rng, 0.5), material++);
            } else {
                scene.add(shape.shape, random_pose(rng, reach_m), material++);
            }
        }
    }
    return scene;
}

std::vector<glm::vec3> full_turn() {
    std::vector<glm::vec3> directions;
    for (std::size_t i = 0; i < beams; ++i) {
        const double angle_rad = glm::radians(double(i));
        directions.emplace_back(std::cos(angle_rad), std::sin(angle_rad), 0.0);
    }
    return directions;
}

/// Where both see the same object, and not too flat, they agree to the millimetre.
struct Agreement {
    int rays = 0;
    int met = 0;
    int differ = 0;  ///< a ray that touches a silhouette may take either side
    int flat = 0;

    void compare(const Hit& hit, const Hit& truth) {
        ++rays;
        if (truth.met()) ++met;
        if (hit.object != truth.object) {
            ++differ;
        } else if (!truth.met()) {
            EXPECT_EQ(hit.range_m, nothing);
        } else if (truth.cos_incidence < 0.2F) {
            ++flat;
        } else {
            EXPECT_EQ(hit.material, truth.material);
            EXPECT_NEAR(hit.range_m, truth.range_m, range_tolerance_m);
            EXPECT_NEAR(hit.cos_incidence, truth.cos_incidence, 0.05);
        }
    }
};

/// What stands still first, then one movable model after the other.
std::vector<Hit> cast_apart(RangeBackend& backend, Fan fan) {
    std::vector<Hit> hits(fan.directions.size());
    fan.can_meet = std::span<const ModelId>{};
    backend.cast(fan, hits);
    for (ModelId model = 0; model < backend.scene().models.size(); ++model) {
        if (!backend.scene().models[model].movable) continue;
        fan.can_meet = {&model, 1};
        backend.cast_moving(fan, hits);
    }
    return hits;
}

class AgreementWithTheOracle : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(All, AgreementWithTheOracle, testing::ValuesIn(backend_names()),
                         [](const auto& test) { return test.param; });

TEST_P(AgreementWithTheOracle, InClutteredWorldsWhoseModelsMove) {
    if (const auto why = what_lacks(GetParam()); !why.empty()) GTEST_SKIP() << why;
    Rng rng(1234);
    Agreement agreement;
    const std::vector<glm::vec3> directions = full_turn();
    for (int world = 0; world < 4; ++world) {
        const SharedScene scene = clutter(rng).build();
        const auto backend = make_backend(GetParam(), scene);
        const auto oracle = make_backend("reference", scene);
        const Pose world_from_middle{scene->anchor_m, Pose{}.rotation};
        for (int scan = 0; scan < 10; ++scan) {
            for (ModelId model = 0; model < scene->models.size(); ++model) {
                if (!scene->models[model].movable) continue;
                const Pose pose = world_from_middle * random_pose(rng, 10.0);
                backend->move(model, pose);
                oracle->move(model, pose);
            }
            const std::vector<Pose> pose{world_from_middle * random_pose(rng, 3.0)};
            std::vector<Hit> hits(beams);
            std::vector<Hit> truth(beams);
            backend->cast({directions, pose, 60.0F}, hits);
            oracle->cast({directions, pose, 60.0F}, truth);
            for (std::size_t i = 0; i < beams; ++i)
                agreement.compare(hits[i], truth[i]);
            if (!backend->casts_apart()) continue;
            const auto apart = cast_apart(*backend, {directions, pose, 60.0F});
            for (std::size_t i = 0; i < beams; ++i)
                agreement.compare(apart[i], truth[i]);
            // The same without what is met first ahead and to the sides.
            const std::vector<ObjectId> first{truth[0].object, truth[beams / 4].object,
                                              truth[beams / 2].object};
            const Fan behind{directions, pose, 60.0F, {no_model, first}};
            oracle->cast(behind, truth);
            const auto apart_behind = cast_apart(*backend, behind);
            for (std::size_t i = 0; i < beams; ++i)
                agreement.compare(apart_behind[i], truth[i]);
        }
    }
    EXPECT_GT(agreement.met, agreement.rays / 3);
    EXPECT_LT(agreement.flat, agreement.met / 5);
    EXPECT_LT(agreement.differ, agreement.met / 200);
}

}  // namespace
}  // namespace scipd::sim
