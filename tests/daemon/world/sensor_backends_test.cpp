// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "daemon/world/backend_maker.h"
#include "sim/loaders/file/confined.h"
#include "tests/support/name_of_backend.h"
#include "tests/support/sanitized.h"
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

RequestedBackend requested(const std::string& sensor, const std::optional<std::string>& backend,
                           int beams = 9) {
    RequestedBackend request;
    request.sensor = sensor;
    request.backend = backend;
    request.max_range_m = 30.0F;
    for (int i = 0; i < beams; ++i) {
        const double angle_rad = 0.05 * (i - beams / 2);
        request.directions.emplace_back(std::cos(angle_rad), std::sin(angle_rad), 0.0);
    }
    return request;
}

float range_ahead_m(SensorBackends& backends, const std::string& sensor) {
    const std::vector<glm::vec3> forward{{1, 0, 0}};
    const std::vector<sim::Pose> pose(1);
    std::vector<sim::Hit> hits(1);
    backends.of(sensor).cast({forward, pose}, hits);
    return hits[0].range_m;
}

TEST(SensorBackends, AreWhatWasAskedForByName) {
    const std::vector<RequestedBackend> requests{
        requested("a/1", "embree"), requested("a/2", "reference"), requested("b/1", "embree")};
    SensorBackends backends = make_backends(requests, scene_of(1));
    EXPECT_EQ(name_of(backends.of("a/1")), "embree");
    EXPECT_EQ(name_of(backends.of("a/2")), "reference");
    EXPECT_EQ(backends.choice_of("a/2")->backend, "reference");
    EXPECT_EQ(backends.choice_of("a/2")->reason, "");
    EXPECT_FLOAT_EQ(range_ahead_m(backends, "a/2"), 4.0F);
}

// Who has no Embree is not told to use it.
TEST(SensorBackends, ThatCannotBeHadSayWhatElseThereIs) {
    if (tests::sanitized) GTEST_SKIP() << tests::sanitizers_want_memory;
    const sim::Confines little{.processor_time = std::chrono::seconds{20},
                               .memory_bytes = 10'000'000};
    const auto made_with_little = [&] {
        sim::run_confined(little, [](std::FILE*) {
            (void)make_backends(std::vector{requested("a/1", std::nullopt)}, scene_of(1));
        });
    };
    EXPECT_THAT(made_with_little,
                testing::ThrowsMessage<std::runtime_error>(
                    "a/1: backend embree: Embree does not start: there is too little memory; give "
                    "scipd more memory, or use reference, which is slow"));
}

TEST(SensorBackends, AreSharedByThoseThatWantTheSame) {
    const std::vector<RequestedBackend> requests{
        requested("a/1", "embree"), requested("a/2", "reference"), requested("b/1", "embree")};
    SensorBackends backends = make_backends(requests, scene_of(1));
    EXPECT_EQ(&backends.of("a/1"), &backends.of("b/1"));
    EXPECT_NE(&backends.of("a/1"), &backends.of("a/2"));
}

TEST(SensorBackends, AreRaysForAutoThatIsNotMeasuredYet) {
    const RequestedBackend open = requested("a/1", std::nullopt);
    SensorBackends backends = make_backends({&open, 1}, scene_of(1));
    EXPECT_EQ(name_of(backends.of("a/1")), "embree");
    EXPECT_EQ(backends.choice_of("a/1")->reason, "not measured yet");
    EXPECT_FALSE(backends.choice_of("a/1")->faces);
}

TEST(BackendMaker, SettlesAutoByMeasuring) {
    BackendMaker maker(scene_of(1));
    RequestedBackend open = requested("a/1", std::nullopt);
    EXPECT_TRUE(maker.is_open(open));
    open.settled = maker.measure(open, {});
    EXPECT_FALSE(maker.is_open(open));
    // On a machine that cannot draw it says why.
    EXPECT_THAT(open.settled->reason,
                testing::AnyOf(testing::MatchesRegex(".* ms per scan.*; (embree|depth): .* ms.*"),
                               HasSubstr("no depth: ")));
    EXPECT_EQ(open.settled->faces, 1U);
    SensorBackends backends = maker.make({&open, 1});
    EXPECT_EQ(name_of(backends.of("a/1")), open.settled->backend);
    EXPECT_EQ(backends.choice_of("a/1"), open.settled);
    EXPECT_FLOAT_EQ(range_ahead_m(backends, "a/1"), 4.0F);
}

TEST(BackendMaker, MeasuresAgainWhenTheSceneHasChangedMuch) {
    RequestedBackend settled = requested("a/1", std::nullopt);
    settled.settled =
        std::make_shared<const BackendChoice>(BackendChoice{"embree", "as before", 10});
    const auto open_in = [&](int boxes) {
        const BackendMaker maker(scene_of(boxes));
        return maker.is_open(settled);
    };
    EXPECT_FALSE(open_in(7));
    EXPECT_FALSE(open_in(15));
    EXPECT_TRUE(open_in(6));
    EXPECT_TRUE(open_in(16));
    // Until then it stays.
    EXPECT_EQ(make_backends({&settled, 1}, scene_of(16)).choice_of("a/1"), settled.settled);
    settled.backend = "reference";
    EXPECT_FALSE(open_in(16));
}

TEST(BackendMaker, EndsMeasuringWhenNobodyWaitsForIt) {
    BackendMaker maker(scene_of(1));
    EXPECT_EQ(maker.measure(requested("a/1", std::nullopt), [] { return true; }), nullptr);
}

// A sphere of 0.5 m is drawn as 25 000 triangles.
TEST(BackendMaker, DrawsNoWorldOfMillionsOfTriangles) {
    sim::SceneBuilder scene;
    for (int i = 0; i < 60; ++i)
        scene.add(sim::Sphere{0.5}, {{4.5 + 2 * i, 0, 0}});
    BackendMaker maker(scene.build());
    RequestedBackend open = requested("a/1", std::nullopt);
    open.settled = maker.measure(open, {});
    EXPECT_EQ(open.settled->backend, "embree");
    EXPECT_THAT(
        open.settled->reason,
        testing::MatchesRegex("no depth: the world has about 1480[0-9][0-9][0-9] triangles to "
                              "draw, and auto draws up to 1000000"));
    EXPECT_FALSE(maker.is_open(open));
    // It was a smaller world in which the depth buffer was the fastest.
    open.settled = std::make_shared<const BackendChoice>(BackendChoice{"depth", "as before", 60});
    EXPECT_EQ(maker.make({&open, 1}).choice_of("a/1")->backend, "embree");
}

TEST(BackendMaker, KnowsAboutHowManyTrianglesAWorldHas) {
    const auto reason = [](const sim::Shape& shape, int copies) {
        sim::SceneBuilder scene;
        for (int i = 0; i < copies; ++i)
            scene.add(shape, {{4.5 + 2 * i, 0, 0}});
        BackendMaker maker(scene.build());
        return maker.measure(requested("a/1", std::nullopt), {})->reason;
    };
    for (const sim::Shape& shape : {sim::Shape{sim::Sphere{0.2}}, sim::Shape{sim::Sphere{3.0}},
                                    sim::Shape{sim::Cylinder{0.8, 1.0}}}) {
        const auto each = static_cast<double>(sim::tessellate(shape).triangles.size());
        const int copies = static_cast<int>(2e6 / each);
        const std::string told = reason(shape, copies);
        double triangles = 0.0;
        ASSERT_EQ(std::sscanf(told.c_str(), "no depth: the world has about %lf", &triangles), 1)
            << told;
        EXPECT_NEAR(triangles / copies, each, 0.05 * each);
    }
}

}  // namespace
}  // namespace scipd::daemon
