// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Every shape, turned any way, seen from outside and from inside, from a hand's breadth to 60 m.
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/sim/backends/contract.h"
#include "tests/sim/backends/convex_shapes.h"

namespace scipd::sim {
namespace {

constexpr int shots_per_shape = 400;
constexpr double least_cosine =
    0.25;  // flatter, a tessellated surface may be off by more than 1 mm
constexpr double round_cos_tolerance =
    0.03;  // half the angle between two flat pieces of a round one

struct Shot {
    Pose test_from_sensor;
    glm::vec3 direction;  ///< in S
    double range_m;
    double cosine;
};

/// A sensor at `from`, turned anyhow, that aims at `surface`.
Shot aim(Rng& rng, const glm::dvec3& from, const SurfacePoint& surface) {
    Shot shot;
    shot.test_from_sensor = {from, random_pose(rng, 0.0).rotation};
    shot.range_m = glm::distance(from, surface.point_m);
    const glm::dvec3 direction = (surface.point_m - from) / shot.range_m;
    shot.direction = inverse(shot.test_from_sensor).rotation * direction;
    shot.cosine = std::abs(glm::dot(direction, surface.normal));
    return shot;
}

SurfacePoint placed(const Pose& test_from_shape, const SurfacePoint& surface) {
    return {test_from_shape * surface.point_m, test_from_shape.rotation * surface.normal};
}

Shot from_outside(Rng& rng, const ConvexShape& shape, const Pose& test_from_shape) {
    const SurfacePoint surface = placed(test_from_shape, shape.random_point(rng));
    glm::dvec3 outward = random_direction(rng);
    while (glm::dot(outward, surface.normal) < least_cosine)
        outward = random_direction(rng);
    const double range_m = std::pow(10.0, uniform(rng, -1.0, std::log10(60.0)));
    return aim(rng, surface.point_m + range_m * outward, surface);
}

Shot from_inside(Rng& rng, const ConvexShape& shape, const Pose& test_from_shape) {
    for (;;) {
        const SurfacePoint ahead = placed(test_from_shape, shape.random_point(rng));
        const SurfacePoint behind = placed(test_from_shape, shape.random_point(rng));
        const double share = uniform(rng, 0.1, 0.9);
        const Shot shot = aim(rng, glm::mix(ahead.point_m, behind.point_m, share), ahead);
        if (shot.cosine >= least_cosine) return shot;
    }
}

class SurfaceContract : public Contract {
  protected:
    void expect_hits(const ConvexShape& shape, const std::vector<Shot>& shots) {
        std::vector<glm::vec3> directions;
        std::vector<Pose> poses;
        for (const Shot& shot : shots) {
            directions.push_back(shot.direction);
            poses.push_back(shot.test_from_sensor);
        }
        const bool round = shape.name == "cylinder" || shape.name == "sphere";
        const std::vector<Hit> hits = cast(directions, poses);
        for (std::size_t i = 0; i < shots.size(); ++i) {
            EXPECT_NEAR(hits[i].range_m, shots[i].range_m, range_tolerance_m) << shape.name;
            EXPECT_NEAR(hits[i].cos_incidence, shots[i].cosine, round ? round_cos_tolerance : 1e-4)
                << shape.name;
        }
    }

    /// Loads one shape at a time, standing still or movable, and shoots at it.
    template <typename Shoot>
    void check_every_shape(bool movable, Shoot shoot) {
        Rng rng(4711);
        for (const ConvexShape& shape : convex_shapes()) {
            const Pose test_from_shape = random_pose(rng, 20.0);
            if (movable) {
                load(scene().movable(random_pose(rng, 5.0)).with(shape.shape, {}));
                move(0, test_from_shape);
            } else {
                load(scene().add(shape.shape, test_from_shape));
            }
            std::vector<Shot> shots;
            for (int i = 0; i < shots_per_shape; ++i)
                shots.push_back(shoot(rng, shape, test_from_shape));
            expect_hits(shape, shots);
        }
    }
};

Shot from_inside_or_outside(Rng& rng, const ConvexShape& shape, const Pose& test_from_shape) {
    return shape.has_inside ? from_inside(rng, shape, test_from_shape)
                            : from_outside(rng, shape, test_from_shape);
}

INSTANTIATE_TEST_SUITE_P(All, SurfaceContract, every_backend_everywhere(), contract_name);

TEST_P(SurfaceContract, FromOutside) {
    check_every_shape(false, from_outside);
}

TEST_P(SurfaceContract, FromInside) {
    check_every_shape(false, from_inside_or_outside);
}

TEST_P(SurfaceContract, FromOutsideAfterAMove) {
    check_every_shape(true, from_outside);
}

TEST_P(SurfaceContract, FromInsideAfterAMove) {
    check_every_shape(true, from_inside_or_outside);
}

}  // namespace
}  // namespace scipd::sim
