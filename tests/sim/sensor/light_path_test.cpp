// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Light that goes on: through panes and back from mirrors, against geometry.
#include "sim/sensor/light_path.h"

#include <cmath>

#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "tests/sim/sensor/lit_scan.h"

namespace scipd::sim {
namespace {

const Surface glass{.diffuse = 0.02F, .specular = 0.04F, .gloss = 2000.0F, .transmission = 0.9F};
const Surface mirror{.diffuse = 0.0F, .specular = 0.9F, .gloss = 1e5F};

class LightPath : public testing::TestWithParam<const char*> {
  protected:
    [[nodiscard]] SharedScan scan(const SharedScene& scene,
                                  const std::vector<Surface>& surfaces) const {
        return lit_scan(GetParam(), scene, surfaces, small_scanner(0.002));
    }
};

// A pane has two faces, and the light passes both twice.
TEST_P(LightPath, GoesThroughAPane) {
    const auto scene = SceneBuilder()
                           .add(Box{{0.006, 10.0, 10.0}}, ahead(2.003), 1)
                           .add(Box{{0.2, 20.0, 20.0}}, ahead(5.1), 2)
                           .build();
    const auto seen = scan(scene, {white, glass, white});
    const std::size_t aside = front_beam + 15;  // the front beam sees the pane's own gloss
    for (const std::size_t beam : {front_beam, aside}) {
        const double cosine = std::cos(glm::radians(double(beam - front_beam)));
        const auto echoes = seen->echoes[beam];
        ASSERT_EQ(echoes.size(), 2U) << beam;
        EXPECT_NEAR(echoes[0].range_m, 2.0 / cosine, 0.01);
        EXPECT_EQ(echoes[0].material, 1U);
        EXPECT_NEAR(echoes[1].range_m, 5.0 / cosine, 2e-3);
        EXPECT_NEAR(echoes[1].power, std::pow(0.9, 4) * cosine, 5e-3);
        EXPECT_EQ(echoes[1].material, 2U);
    }
    EXPECT_GT(seen->echoes[front_beam][0].power, 20 * seen->echoes[aside][0].power);
}

TEST_P(LightPath, ShowsAWallInAMirror) {
    const Pose turned = pose_from_rpy({3.0, 0.0, 0.0}, {0.0, 0.0, glm::radians(45.0)});
    const auto scene = SceneBuilder()
                           .add(Box{{0.002, 3.0, 3.0}}, turned, 1)
                           .add(Box{{20.0, 0.2, 20.0}}, ahead(3.0, -4.1), 2)  // to the right
                           .add(Box{{20.0, 0.2, 20.0}}, ahead(3.0, 4.1), 3)   // to the left
                           .build();
    const auto seen = scan(scene, {white, mirror, white, {.diffuse = 0.5F}});
    // The mirror stands across the line from front right to back left, so it shows the right or the
    // left wall, which are as far away; geometry says which.
    const glm::dvec3 normal{std::cos(glm::radians(45.0)), std::sin(glm::radians(45.0)), 0.0};
    const glm::dvec3 mirrored = glm::dvec3{1, 0, 0} - 2.0 * normal.x * normal;
    const auto echoes = seen->echoes[front_beam];
    ASSERT_EQ(echoes.size(), 1U);  // the mirror itself sends nothing back
    EXPECT_NEAR(echoes[0].range_m, 3.0 + 4.0, 5e-3);
    EXPECT_EQ(echoes[0].material, mirrored.y < 0 ? 2U : 3U);
    EXPECT_NEAR(echoes[0].power, 0.81 * (mirrored.y < 0 ? 1.0 : 0.5), 0.01);
}

// Two mirrors that face each other do not keep the light for ever.
TEST_P(LightPath, EndsBetweenMirrors) {
    const auto scene = SceneBuilder()
                           .add(Box{{0.01, 9.0, 9.0}}, ahead(2.0), 1)
                           .add(Box{{0.01, 9.0, 9.0}}, ahead(-2.0), 1)
                           .build();
    const auto seen = scan(scene, {white, mirror});
    for (const FartherHit& hit : seen->farther) {
        EXPECT_LE(hit.hit.range_m, 60.0F);
        EXPECT_GE(hit.share, least_share);
    }
    EXPECT_LE(seen->farther.size(), seen->hits.size() * most_faces_passed);
}

TEST_P(LightPath, EndsAtWhatIsOpaque) {
    const auto scene = SceneBuilder()
                           .add(Box{{0.2, 10.0, 10.0}}, ahead(2.1), 1)
                           .add(Box{{0.2, 20.0, 20.0}}, ahead(5.1), 2)
                           .build();
    EXPECT_TRUE(scan(scene, {white, white, glass})->farther.empty());
}

INSTANTIATE_TEST_SUITE_P(Through, LightPath, testing::Values("embree", "reference"),
                         [](const auto& backend) { return std::string(backend.param); });

}  // namespace
}  // namespace scipd::sim
