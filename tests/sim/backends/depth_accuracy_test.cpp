// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The published figures: a UST-10LX in the rescue maze by depth buffer and by rays.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include "sim/loaders/sdf/sdf.h"
#include "tests/sim/backends/contract.h"

namespace scipd::sim {
namespace {

constexpr int beams = 1081;
constexpr float max_range_m = 30.0F;
/// Half the distance of the pixels of a strip: what a pixel beside a beam may show.
constexpr double half_pixel_rad = 0.75e-3;
constexpr double at_edge_m = 0.01;

std::vector<glm::vec3> ust_10lx(double turned_rad) {
    std::vector<glm::vec3> directions;
    for (int step = -540; step <= 540; ++step) {
        const double angle_rad = step * std::numbers::pi / 720 + turned_rad;
        directions.emplace_back(std::cos(angle_rad), std::sin(angle_rad), 0.0);
    }
    return directions;
}

/// Along the corridors, a little tilted as on a real floor.
std::vector<Pose> poses() {
    std::vector<Pose> all;
    for (int i = 0; i < 60; ++i) {
        all.push_back(pose_from_rpy({1.0 + 0.3 * (i % 10), 1.0 + 1.5 * double(i / 10), 0.3},
                                    {0.005 * std::sin(i), 0.005 * std::cos(i), 0.7 * i}));
    }
    return all;
}

std::vector<Hit> cast(RangeBackend& backend, const Pose& pose, double turned_rad = 0.0) {
    std::vector<Hit> hits(beams);
    const auto directions = ust_10lx(turned_rad);
    backend.cast({directions, {&pose, 1}, max_range_m}, hits);
    return hits;
}

double percentile(std::vector<double> values, double share) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * double(values.size() - 1));
    std::ranges::nth_element(values, at);
    return *at;
}

/// A beam whose neighbourhood, as far as half a pixel, spans two objects.
bool at_edge(const Hit& hit, const Hit& right, const Hit& left) {
    return hit.object != right.object || hit.object != left.object;
}

TEST(DepthAccuracy, HoldsToItsFiguresInTheRescueMaze) {
    if (const auto why = what_lacks("depth"); !why.empty()) GTEST_SKIP() << why;
    const SharedScene scene = load_sdf(SCIPD_SCENES "/rescue_maze.sdf").scene;
    const auto depth = make_backend("depth", scene);
    const auto rays = make_backend("embree", scene);
    std::vector<double> near_m;
    std::vector<double> far_m;
    int edges = 0;
    int other_surface = 0;
    for (const Pose& pose : poses()) {
        const auto drawn = cast(*depth, pose);
        const auto truth = cast(*rays, pose);
        const auto right = cast(*rays, pose, -half_pixel_rad);
        const auto left = cast(*rays, pose, half_pixel_rad);
        for (int i = 0; i < beams; ++i) {
            const bool edge = at_edge(truth[i], right[i], left[i]);
            if (edge) ++edges;
            const double off_m = std::abs(double{drawn[i].range_m} - double{truth[i].range_m});
            if (drawn[i].met() != truth[i].met() || off_m > at_edge_m) ++other_surface;
            if (edge || !truth[i].met()) continue;
            (truth[i].range_m <= 5.0F ? near_m : far_m).push_back(off_m);
            EXPECT_LT(off_m, at_edge_m);
            // Where two objects touch, either is right.
            if (drawn[i].object != truth[i].object) {
                EXPECT_LT(off_m, 1e-3);
            } else {
                EXPECT_EQ(drawn[i].material, truth[i].material);
            }
        }
    }
    const int all = beams * static_cast<int>(poses().size());
    RecordProperty("edge_share", std::to_string(double(edges) / all));
    EXPECT_GT(near_m.size(), 10'000U);
    EXPECT_LE(percentile(near_m, 0.99), 1e-3);
    EXPECT_LE(percentile(far_m, 0.99), 5e-3);
    EXPECT_LT(edges, all / 100);
    EXPECT_LT(other_surface, all / 1000);
}

}  // namespace
}  // namespace scipd::sim
