// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/range_backend.h"

#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scene_builder.h"

namespace scipd::sim {
namespace {

using testing::ElementsAre;
using testing::Pair;

const Pose there{{1, 2, 3}, {1, 0, 0, 0}};
const std::vector<glm::vec3> ahead(3, glm::vec3{1, 0, 0});

/// Writes down what the checked front hands on.
class Recorder : public RangeBackend {
  public:
    // Model 0 stands still, model 1 can move.
    Recorder()
        : RangeBackend(
              SceneBuilder().add(Sphere{1.0}, {}).movable({}).with(Sphere{1.0}, {}).build()) {}

    std::vector<std::pair<ModelId, Pose>> moves;
    std::vector<std::size_t> casts;

  private:
    void do_move(ModelId model, const Pose& world_from_model) override {
        moves.emplace_back(model, world_from_model);
    }
    void do_cast(const Fan& fan, std::span<Hit> hits) override {
        casts.push_back(fan.directions.size());
        for (Hit& hit : hits)
            hit.range_m = 7.0F;
    }
};

TEST(RangeBackend, MovesOnlyWhatIsNotThereYet) {
    Recorder backend;
    backend.move(1, {});
    EXPECT_THAT(backend.moves, ElementsAre());
    backend.move(1, there);
    backend.move(1, there);
    EXPECT_THAT(backend.moves, ElementsAre(Pair(1, there)));
    backend.move(1, {});
    EXPECT_THAT(backend.moves, ElementsAre(Pair(1, there), Pair(1, Pose{})));
}

TEST(RangeBackend, HandsOnAFanWithOnePoseOrOnePerRay) {
    Recorder backend;
    const std::vector<Pose> poses(3);
    std::vector<Hit> hits(3);
    backend.cast({ahead, poses}, hits);
    backend.cast({ahead, {poses.data(), 1}, 30.0F, 1}, hits);
    backend.cast({{}, {poses.data(), 1}}, {});
    EXPECT_THAT(backend.casts, ElementsAre(3, 3, 0));
    EXPECT_EQ(hits[2].range_m, 7.0F);
}

// What runs tests keeps asserts; without them nobody would notice that these are gone.
/// Meets an object that its scene does not have.
class Liar : public Recorder {
    void do_cast(const Fan&, std::span<Hit> hits) override { hits.front().object = 99; }
};

TEST(RangeBackendDeathTest, RefusesAnObjectThatIsNotThere) {
    const Pose pose;
    std::vector<Hit> hits(3);
    Liar backend;
    EXPECT_DEATH(backend.cast({ahead, {&pose, 1}}, hits), "objects.size");
}

TEST(RangeBackendDeathTest, RefusesWhatDoesNotFit) {
#ifdef NDEBUG
    FAIL() << "asserts are off: build the tests with -DSCIPD_ASSERTS=ON";
#else
    Recorder backend;
    const std::vector<Pose> poses(2);
    const std::span<const Pose> one_pose{poses.data(), 1};
    std::vector<Hit> hits(3);
    EXPECT_DEATH(backend.cast({ahead, poses}, hits), "world_from_sensor");
    EXPECT_DEATH(backend.cast({ahead, one_pose}, {hits.data(), 2}), "hits.size");
    EXPECT_DEATH(backend.cast({ahead, one_pose, -1.0F}, hits), "max_range_m");
    EXPECT_DEATH(backend.cast({ahead, one_pose, 30.0F, 0}, hits), "unseen");
    EXPECT_DEATH(backend.move(0, {}), "movable");
    EXPECT_DEATH(backend.move(2, {}), "models.size");
#endif
}

}  // namespace
}  // namespace scipd::sim
