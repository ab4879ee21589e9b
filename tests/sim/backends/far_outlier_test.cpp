// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What lies far off costs nobody a millimetre, as found in a public bookstore: one book lies 343 km
// up.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sim/backends/registry.h"
#include "tests/sim/backends/contract.h"
#include "tests/sim/backends/convex_shapes.h"

namespace scipd::sim {
namespace {

constexpr std::size_t beams = 360;

std::vector<glm::vec3> full_turn() {
    std::vector<glm::vec3> directions;
    for (std::size_t i = 0; i < beams; ++i) {
        const double angle_rad = glm::radians(double(i) + 0.3);
        directions.emplace_back(std::cos(angle_rad), std::sin(angle_rad), 0.0);
    }
    return directions;
}

Pose at(double x_m, double y_m, double z_m, double yaw_rad = 0.0) {
    return pose_from_rpy({x_m, y_m, z_m}, {0, 0, yaw_rad});
}

/// A room with shelves that stand askew, so that no coordinate is a round number.
SceneBuilder bookstore() {
    SceneBuilder scene;
    for (int i = 0; i < 8; ++i) {
        const double angle_rad = i * 0.7853 + 0.1;
        scene.add(Box{{0.37, 3.3, 2.1}},
                  at(7.3 * std::cos(angle_rad), 6.1 * std::sin(angle_rad), 1.0, angle_rad));
    }
    scene.movable(at(1.7, -2.3, 0.6, 0.4)).with(Box{{0.5, 0.7, 1.3}}, {});
    return scene;
}

class FarOutlier : public testing::TestWithParam<std::string> {
  protected:
    /// The largest difference from the oracle where both meet the same thing.
    double largest_error_m(const SharedScene& scene, const glm::dvec3& from_m) {
        const auto backend = make_backend(GetParam(), scene);
        const auto oracle = make_backend("reference", scene);
        const std::vector<glm::vec3> directions = full_turn();
        const std::vector<Pose> pose{at(from_m.x, from_m.y, from_m.z, 0.01)};
        std::vector<Hit> hits(beams);
        std::vector<Hit> truth(beams);
        backend->cast({directions, pose, 30.0F}, hits);
        oracle->cast({directions, pose, 30.0F}, truth);
        double largest_m = 0.0;
        met_ = 0;
        for (std::size_t i = 0; i < beams; ++i) {
            if (!truth[i].met() || hits[i].object != truth[i].object) continue;
            if (truth[i].cos_incidence < 0.2F) continue;
            ++met_;
            largest_m = std::max(largest_m, std::abs(double{hits[i].range_m} - truth[i].range_m));
        }
        return largest_m;
    }

    int met_ = 0;
};

INSTANTIATE_TEST_SUITE_P(All, FarOutlier, testing::ValuesIn(backend_names()),
                         [](const auto& test) { return test.param; });

TEST_P(FarOutlier, costsNobodyAnything) {
    if (const auto why = what_lacks(GetParam()); !why.empty()) GTEST_SKIP() << why;
    SceneBuilder scene = bookstore();
    scene.add(Box{{0.2, 0.3, 0.05}}, at(0.7, 1.1, 343'000));
    scene.add(Box{{1, 1, 1}}, at(0, 0, 10'000));
    scene.movable(at(-80'000, 0, 0)).with(Box{{1, 1, 1}}, {});
    EXPECT_LT(largest_error_m(scene.build(), {0.123, -0.456, 0.7}), 3e-5);
    EXPECT_GT(met_, 200);
}

// As the loader promises it, and warns beyond.
TEST_P(FarOutlier, oneKilometreFromTheAnchorLessThanATenthOfAMillimetreIsLost) {
    if (const auto why = what_lacks(GetParam()); !why.empty()) GTEST_SKIP() << why;
    auto scene = std::make_shared<Scene>(*bookstore().build());
    scene->anchor_m = {-700, 690, 300};
    EXPECT_LT(largest_error_m(scene, {0.123, -0.456, 0.7}), 1e-4);
    EXPECT_GT(met_, 200);
}

}  // namespace
}  // namespace scipd::sim
