// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Pictures made by hand, so that what a beam makes of them can be told apart from what was drawn.
#include "sim/backends/depth_sampler.h"

#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/support/scene_builder.h"

namespace scipd::sim {
namespace {

constexpr std::uint32_t nothing = Picture::nothing;

/// A screen 3 m ahead, left of y = 0, with a wall 10 m ahead behind it. Each is two triangles.
class BeamCutting : public testing::Test {
  protected:
    static Pose standing(double x, double y) {
        return pose_from_rpy({x, y, 0}, {0, std::numbers::pi / 2, 0});
    }

    /// The triangle of an object that a direction meets.
    [[nodiscard]] TriangleId shown_by(ObjectId object, double left, double up) const {
        const double x = object == screen ? 3.0 : 10.0;
        const glm::dvec3 point{x, left * x, up * x};
        for (TriangleId id = 0; id < triangles_.triangles().size(); ++id) {
            if (triangles_.faces()[id].object == object && inside(id, point)) return id;
        }
        return nothing;
    }

    /// One beam between two pixels that look at tangents 0.01 apart, with depths as drawn or as
    /// given.
    Hit sampled(BetweenPixels between, std::vector<TriangleId> shown, double left,
                const std::vector<double>& z_m) {
        picture_.size_px = {2, 1};
        picture_.triangle = std::move(shown);
        picture_.depth.clear();
        for (const double z : z_m)
            picture_.depth.push_back(static_cast<float>(near_m / z));
        const auto direction = glm::normalize(glm::dvec3{1, left, 0});
        const std::vector<glm::vec3> directions{direction};
        const std::vector<Pose> poses(1);
        const std::vector<Look> looks{{.ray = 0,
                                       .pixel = 0,
                                       .share = {(left + 0.005) / 0.01, 0.0},
                                       .cos_alpha = static_cast<float>(direction.x)}};
        std::vector<Hit> hits(1);
        const Pose anchored_from_sensor{-scene_->anchor_m, Pose{}.rotation};
        DepthSampler(*scene_, triangles_, picture_, between, anchored_from_sensor)
            .sample(looks, {directions, poses}, hits);
        cosine_ = direction.x;
        return hits[0];
    }

    /// The distance ahead of what is cut.
    double ahead_m(BetweenPixels between, const std::vector<TriangleId>& shown, double left,
                   const std::vector<double>& z_m) {
        const double range_m = sampled(between, shown, left, z_m).range_m;
        return range_m * cosine_;
    }

    static constexpr ObjectId screen = 0;
    static constexpr ObjectId wall = 1;
    SharedScene scene_ = SceneBuilder()
                             .add(Plane{{4, 4}}, standing(3, 2), 1)
                             .add(Plane{{50, 50}}, standing(10, 3), 2)
                             .build();
    DepthTriangles triangles_{*scene_};
    Picture picture_;
    double cosine_ = 1.0;

  private:
    [[nodiscard]] bool inside(TriangleId id, const glm::dvec3& point) const {
        const glm::uvec3 corners = triangles_.triangles()[id].corners;
        std::vector<double> sides;
        for (int i = 0; i < 3; ++i) {
            const auto at = [&](int k) {
                return glm::dvec3{triangles_.vertices()[corners[k % 3]].position_m} +
                       scene_->anchor_m;
            };
            sides.push_back(glm::cross(at(i + 1) - at(i), point - at(i)).x);
        }
        return (sides[0] >= 0) == (sides[1] >= 0) && (sides[1] >= 0) == (sides[2] >= 0);
    }
};

TEST_F(BeamCutting, DecidesAnEdgeByTheSideOfTheBeam) {
    const std::vector<TriangleId> shown{shown_by(wall, -0.005, 0), shown_by(screen, 0.005, 0)};
    ASSERT_NE(shown[0], nothing);
    ASSERT_NE(shown[1], nothing);
    for (const auto between : {BetweenPixels::interpolate, BetweenPixels::exact}) {
        for (const double left : {-0.004, -1e-5, 1e-5, 0.004}) {
            const Hit hit = sampled(between, shown, left, {10.0, 3.0});
            EXPECT_EQ(hit.object, left > 0 ? screen : wall);
            EXPECT_EQ(hit.material, left > 0 ? 1U : 2U);
            EXPECT_NEAR(hit.range_m, (left > 0 ? 3.0 : 10.0) / cosine_, 1e-5);
        }
    }
}

TEST_F(BeamCutting, SeesPastAnEdgeWithNothingBehind) {
    const std::vector<TriangleId> shown{nothing, shown_by(screen, 0.005, 0)};
    EXPECT_FALSE(sampled(BetweenPixels::exact, shown, -0.001, {1e9, 3.0}).met());
    EXPECT_EQ(sampled(BetweenPixels::exact, shown, 0.001, {1e9, 3.0}).object, screen);
}

// Two pixels that show triangles which the beam passes, one far above and one far below: something
// small is there that no pixel shows.
TEST_F(BeamCutting, TakesTheNearestPixelsPlaneWhereNoTriangleIsMet) {
    std::vector<TriangleId> passed;
    for (const double up : {-2.0, 2.0}) {
        const TriangleId id = shown_by(wall, 0.4, up);
        if (id != shown_by(wall, 0.0, 0.0)) passed.push_back(id);
    }
    ASSERT_FALSE(passed.empty());
    passed.resize(2, passed[0]);
    const Hit hit = sampled(BetweenPixels::exact, {passed[0], passed[1]}, 0.002, {10.0, 10.0});
    EXPECT_EQ(hit.object, wall);
    EXPECT_NEAR(hit.range_m, 10.0 / cosine_, 1e-5);
}

TEST_F(BeamCutting, GoesByTheNearestPixelsDepthWhereThatIsTheAnswer) {
    const std::vector<TriangleId> shown(2, shown_by(wall, 0.0, 0));
    EXPECT_NEAR(ahead_m(BetweenPixels::nearest, shown, -0.001, {7.0, 8.0}), 7.0, 1e-5);
    EXPECT_NEAR(ahead_m(BetweenPixels::nearest, shown, 0.001, {7.0, 8.0}), 8.0, 1e-5);
    EXPECT_FALSE(sampled(BetweenPixels::nearest, {nothing, shown[1]}, -0.001, {1e9, 8.0}).met());
}

TEST_F(BeamCutting, InterpolatesTheInverseOfTheDepth) {
    const std::vector<TriangleId> shown(2, shown_by(wall, 0.0, 0));
    const double middle_m = 2.0 / (1.0 / 7.0 + 1.0 / 8.0);
    EXPECT_NEAR(ahead_m(BetweenPixels::interpolate, shown, 0.0, {7.0, 8.0}), middle_m, 1e-5);
}

TEST_F(BeamCutting, TakesThePlaneAndNotTheDepthWhereExact) {
    const std::vector<TriangleId> shown(2, shown_by(wall, 0.0, 0));
    EXPECT_NEAR(ahead_m(BetweenPixels::exact, shown, 0.002, {10.05, 10.05}), 10.0, 1e-5);
}

TEST_F(BeamCutting, TellsTheIncidence) {
    const std::vector<TriangleId> shown(2, shown_by(wall, 0.0, 0));
    const Hit hit = sampled(BetweenPixels::exact, shown, 0.004, {10.0, 10.0});
    EXPECT_NEAR(hit.cos_incidence, cosine_, 1e-6);
}

}  // namespace
}  // namespace scipd::sim
