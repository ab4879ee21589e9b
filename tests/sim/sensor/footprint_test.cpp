// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The rays of a footprint against the moments of the Gaussian beam that they stand for.
#include "sim/sensor/footprint.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "sim/sensor/beam_pattern.h"

namespace scipd::sim {
namespace {

double moment(int rays, int across, int up) {
    double sum = 0.0;
    for (const FootprintRay& ray : footprint_rays(rays))
        sum += double{ray.weight} * std::pow(ray.across, across) * std::pow(ray.up, up);
    return sum;
}

// The light exp(-2 r²) is a normal distribution along each axis, with a deviation of a half.
TEST(Footprint, HasTheMomentsOfAGaussianBeam) {
    for (const int rays : {7, 13}) {
        EXPECT_NEAR(moment(rays, 0, 0), 1.0, 1e-6) << rays;
        EXPECT_NEAR(moment(rays, 1, 0), 0.0, 1e-6) << rays;
        EXPECT_NEAR(moment(rays, 2, 0), 0.25, 1e-6) << rays;
        EXPECT_NEAR(moment(rays, 0, 2), 0.25, 1e-6) << rays;
        EXPECT_NEAR(moment(rays, 1, 1), 0.0, 1e-6) << rays;
        EXPECT_NEAR(moment(rays, 4, 0), 3.0 / 16.0, 1e-6) << rays;
        EXPECT_NEAR(moment(rays, 2, 2), 1.0 / 16.0, 1e-6) << rays;
    }
    EXPECT_EQ(footprint_rays(1).size(), 1U);
    EXPECT_EQ(footprint_rays(7).size(), 7U);
    EXPECT_EQ(footprint_rays(13).size(), 13U);
}

// So that something thin, upright or level, meets a ray at as many places as there are rays.
TEST(Footprint, HasNoTwoRaysAboveOrBesideEachOther) {
    for (const int rays : {7, 13}) {
        for (const auto along : {&FootprintRay::across, &FootprintRay::up}) {
            std::vector<double> places;
            for (const FootprintRay& ray : footprint_rays(rays))
                places.push_back(ray.*along);
            std::ranges::sort(places);
            for (std::size_t i = 1; i < places.size(); ++i)
                EXPECT_GT(places[i] - places[i - 1], 0.1) << rays;
        }
    }
}

TEST(Footprint, IsTheModelsOwnEllipse) {
    const SensorSpec spec{
        .steps_per_turn = 4,
        .first_step = 0,
        .last_step = 1,
        .front_step = 0,
        .footprint = {.half_width_rad = 0.01, .half_height_rad = 0.002, .rays = 7}};
    const BeamPattern pattern(spec);
    ASSERT_EQ(pattern.directions().size(), 14U);
    float widest = 0.0F;
    float highest = 0.0F;
    for (std::size_t i = 0; i < 7; ++i) {
        const glm::vec3 ahead = pattern.directions()[i];
        widest = std::max(widest, std::abs(std::atan2(ahead.y, ahead.x)));
        highest = std::max(highest, std::abs(std::asin(ahead.z)));
        EXPECT_NEAR(glm::length(ahead), 1.0F, 1e-6);
        // The second beam is the first one, turned by a right angle.
        const glm::vec3 left = pattern.directions()[7 + i];
        EXPECT_NEAR(glm::length(left - glm::vec3(-ahead.y, ahead.x, ahead.z)), 0.0F, 1e-6);
    }
    const double turned = std::cos(glm::radians(15.0));
    EXPECT_NEAR(widest, 0.01 * turned, 1e-6);
    EXPECT_NEAR(highest, 0.002 * turned, 1e-6);
    const double low = std::sin(glm::radians(15.0));
    EXPECT_NEAR(spec.footprint.reach_rad(), std::hypot(0.01 * turned, 0.002 * low), 1e-9);
    EXPECT_EQ(pattern.directions()[0], glm::vec3(1, 0, 0));
}

}  // namespace
}  // namespace scipd::sim
