// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/control/sensor_backends.h"

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "tests/support/scene_builder.h"

namespace scipd::daemon {
namespace {

using testing::HasSubstr;

sim::SharedScene scene_of(int boxes) {
    sim::SceneBuilder scene;
    for (int i = 0; i < boxes; ++i)
        scene.add(sim::Box{{1.0, 10.0, 10.0}}, sim::pose_from_rpy({4.5 + 2 * i, 0, 0}, {0, 0, 0}));
    return scene.build();
}

BackendWish wish(const std::string& sensor, const std::string& backend, int beams = 9) {
    BackendWish wish;
    wish.sensor = sensor;
    wish.backend = backend;
    wish.max_range_m = 30.0F;
    for (int i = 0; i < beams; ++i) {
        const double angle_rad = 0.05 * (i - beams / 2);
        wish.directions.emplace_back(std::cos(angle_rad), std::sin(angle_rad), 0.0);
    }
    return wish;
}

float range_ahead_m(const SensorBackends& backends, const std::string& sensor) {
    const std::vector<glm::vec3> forward{{1, 0, 0}};
    const std::vector<sim::Pose> pose(1);
    std::vector<sim::Hit> hits(1);
    backends.of(sensor).cast({forward, pose}, hits);
    return hits[0].range_m;
}

TEST(SensorBackends, AreWhatWasAskedForByName) {
    const std::vector<BackendWish> wishes{wish("a/1", "embree"), wish("a/2", "reference"),
                                          wish("b/1", "embree")};
    const SensorBackends backends = make_backends(wishes, scene_of(1));
    EXPECT_EQ(backends.of("a/1").name(), "embree");
    EXPECT_EQ(backends.of("a/2").name(), "reference");
    EXPECT_EQ(backends.choice_of("a/2")->backend, "reference");
    EXPECT_EQ(backends.choice_of("a/2")->reason, "");
    EXPECT_FLOAT_EQ(range_ahead_m(backends, "a/2"), 4.0F);
}

TEST(SensorBackends, AreSharedByThoseThatWantTheSame) {
    const std::vector<BackendWish> wishes{wish("a/1", "embree"), wish("a/2", "reference"),
                                          wish("b/1", "embree")};
    const SensorBackends backends = make_backends(wishes, scene_of(1));
    EXPECT_EQ(&backends.of("a/1"), &backends.of("b/1"));
    EXPECT_NE(&backends.of("a/1"), &backends.of("a/2"));
}

TEST(SensorBackends, SettleAutoByMeasuring) {
    const std::vector<BackendWish> wishes{wish("a/1", "auto"), wish("b/1", "auto")};
    const SensorBackends backends = make_backends(wishes, scene_of(1));
    const BackendChoice& choice = *backends.choice_of("a/1");
    EXPECT_EQ(choice.backend, backends.of("a/1").name());
    // On a machine that cannot draw it says why.
    EXPECT_THAT(choice.reason, testing::AnyOf(testing::MatchesRegex("embree takes .* ms, depth .*"),
                                              HasSubstr("no depth: ")));
    EXPECT_EQ(choice.faces, 1U);
    EXPECT_FLOAT_EQ(range_ahead_m(backends, "a/1"), 4.0F);
    EXPECT_NE(backends.choice_of("b/1"), backends.choice_of("a/1")) << "each for itself";
}

TEST(SensorBackends, KeepWhatIsSettledUntilTheSceneChangesMuch) {
    BackendWish settled = wish("a/1", "auto");
    settled.settled =
        std::make_shared<const BackendChoice>(BackendChoice{"embree", "as before", 10});
    const auto choice_in = [&](int boxes) {
        return make_backends({&settled, 1}, scene_of(boxes)).choice_of("a/1");
    };
    EXPECT_EQ(choice_in(7), settled.settled);
    EXPECT_EQ(choice_in(15), settled.settled);
    EXPECT_NE(choice_in(6), settled.settled);
    EXPECT_NE(choice_in(16), settled.settled);
    EXPECT_EQ(choice_in(16)->faces, 16U);
}

TEST(SensorBackends, DoNotMeasureWhereRaysAreSettledForGood) {
    BackendWish settled = wish("a/1", "auto");
    settled.settled = rays_unmeasured("not now");
    const SensorBackends backends = make_backends({&settled, 1}, scene_of(100));
    EXPECT_EQ(backends.choice_of("a/1"), settled.settled);
    EXPECT_EQ(backends.of("a/1").name(), "embree");
}

}  // namespace
}  // namespace scipd::daemon
