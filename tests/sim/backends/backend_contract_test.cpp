// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What every backend owes, against geometry that can be computed by hand.
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "tests/sim/backends/contract.h"

namespace scipd::sim {
namespace {

constexpr double cos_tolerance = 1e-4;

const glm::vec3 forward{1, 0, 0};
const glm::vec3 backward{-1, 0, 0};
const glm::vec3 leftward{0, 1, 0};

Pose at(double x, double y = 0.0, double z = 0.0) {
    return {{x, y, z}, Pose{}.rotation};
}

Pose yawed(double yaw_rad) {
    return pose_from_rpy({0, 0, 0}, {0, 0, yaw_rad});
}

/// The pose of a plane that makes it a wall normal to x.
Pose wall_at(double x) {
    return pose_from_rpy({x, 0, 0}, {0, std::numbers::pi / 2, 0});
}

/// Level directions, evenly from -half to half.
std::vector<glm::vec3> sweep(std::size_t beams, double half_rad) {
    std::vector<glm::vec3> directions;
    for (std::size_t i = 0; i < beams; ++i) {
        const double share = beams == 1 ? 0.5 : double(i) / double(beams - 1);
        const double angle_rad = half_rad * (2.0 * share - 1.0);
        directions.emplace_back(std::cos(angle_rad), std::sin(angle_rad), 0.0);
    }
    return directions;
}

void expect_nothing(const Hit& hit) {
    EXPECT_EQ(hit.range_m, nothing);
    EXPECT_EQ(hit.cos_incidence, 0.0F);
    EXPECT_EQ(hit.material, 0U);
    EXPECT_EQ(hit.object, no_object);
    EXPECT_FALSE(hit.met());
}

using BackendContract = Contract;
INSTANTIATE_TEST_SUITE_P(All, BackendContract, every_backend_everywhere(), contract_name);

TEST_P(BackendContract, MeetsNothingInAnEmptyWorld) {
    load(scene());
    expect_nothing(cast_one(forward));
    EXPECT_TRUE(cast({}, {Pose{}}).empty());
    EXPECT_TRUE(cast({}, {}).empty());
}

TEST_P(BackendContract, MeetsNothingBehindOrBeside) {
    load(scene().add(Box{{1, 1, 1}}, at(5)));
    expect_nothing(cast_one(backward));
    expect_nothing(cast_one(leftward));
}

TEST_P(BackendContract, MeasuresAlongTheRayUpTo60Metres) {
    for (const double wall_m : {0.02, 0.5, 3.0, 30.0, 60.0}) {
        load(scene().add(Plane{{200, 200}}, wall_at(wall_m)));
        for (const double angle_rad : {-1.2, -0.3, 0.0, 0.7, 1.2}) {
            const double range_m = wall_m / std::cos(angle_rad);
            if (range_m > 60.0) continue;
            const Hit hit = cast_one(forward, yawed(angle_rad));
            EXPECT_NEAR(hit.range_m, range_m, range_tolerance_m);
            EXPECT_NEAR(hit.cos_incidence, std::cos(angle_rad), cos_tolerance);
        }
    }
}

// From one ray over a full packet to many and a rest: each is filled with its own answer.
TEST_P(BackendContract, AnswersEveryRayOfAFanOfAnySize) {
    load(scene().add(Plane{{200, 200}}, wall_at(4)));
    for (const std::size_t beams : {1U, 2U, 15U, 16U, 17U, 31U, 32U, 33U, 1081U}) {
        const std::vector<glm::vec3> directions = sweep(beams, 1.3);
        const std::vector<Hit> hits = cast(directions, {Pose{}});
        for (std::size_t i = 0; i < beams; ++i) {
            ASSERT_NEAR(hits[i].range_m, 4.0 / double{directions[i].x}, range_tolerance_m)
                << "ray " << i << " of " << beams;
        }
    }
}

TEST_P(BackendContract, TakesAPoseForEachRay) {
    load(scene().add(Plane{{200, 200}}, wall_at(50)));
    std::vector<Pose> poses;
    for (int i = 0; i < 100; ++i)
        poses.push_back(at(0.3 * i, 0.1 * i) * yawed(0.01 * i));
    const std::vector<Hit> hits = cast(std::vector<glm::vec3>(100, forward), poses);
    for (int i = 0; i < 100; ++i) {
        const double cosine = std::cos(0.01 * i);
        EXPECT_NEAR(hits[i].range_m, (50 - 0.3 * i) / cosine, range_tolerance_m) << i;
        EXPECT_NEAR(hits[i].cos_incidence, cosine, cos_tolerance) << i;
    }
}

TEST_P(BackendContract, AnswersTheSameForOnePoseAndForEqualOnes) {
    load(scene().add(Sphere{1.0}, at(6)).add(Plane{{200, 200}}, wall_at(9)));
    const std::vector<glm::vec3> directions = sweep(101, 0.8);
    const Pose pose = pose_from_rpy({1, 0.5, 0.2}, {0.1, 0.05, -0.2});
    const std::vector<Hit> one = cast(directions, {pose});
    const std::vector<Hit> each = cast(directions, std::vector<Pose>(101, pose));
    for (std::size_t i = 0; i < directions.size(); ++i) {
        EXPECT_NEAR(one[i].range_m, each[i].range_m, 1e-5);
        EXPECT_EQ(one[i].object, each[i].object);
    }
}

TEST_P(BackendContract, SeesTheNearestOfSeveral) {
    load(scene()
             .add(Box{{1, 1, 1}}, at(10), 1)
             .add(Box{{1, 1, 1}}, at(5), 2)
             .add(Box{{1, 1, 1}}, at(20), 3));
    const Hit hit = cast_one(forward);
    EXPECT_NEAR(hit.range_m, 4.5, range_tolerance_m);
    EXPECT_EQ(hit.object, 1U);
    EXPECT_EQ(hit.material, 2U);
}

TEST_P(BackendContract, TellsObjectAndMaterialOfEveryRay) {
    load(scene().add(Box{{1, 1, 1}}, at(5, -2), 3).add(Box{{1, 1, 1}}, at(5, 2), 1));
    const std::vector<Hit> hits =
        cast({glm::normalize(glm::vec3{5, -2, 0}), forward, glm::normalize(glm::vec3{5, 2, 0})},
             {Pose{}});
    EXPECT_EQ(hits[0].object, 0U);
    EXPECT_EQ(hits[0].material, 3U);
    expect_nothing(hits[1]);
    EXPECT_EQ(hits[2].object, 1U);
    EXPECT_EQ(hits[2].material, 1U);
}

TEST_P(BackendContract, SeesBothFaces) {
    load(scene().add(Plane{{10, 10}}, wall_at(0)));
    const Hit front = cast_one(forward, at(-2));
    const Hit back = cast_one(backward, at(3));
    EXPECT_NEAR(front.range_m, 2.0, range_tolerance_m);
    EXPECT_NEAR(back.range_m, 3.0, range_tolerance_m);
    EXPECT_NEAR(front.cos_incidence, 1.0, cos_tolerance);
    EXPECT_NEAR(back.cos_incidence, 1.0, cos_tolerance);
}

TEST_P(BackendContract, SeesTheNearAndTheFarFaceOfABox) {
    load(scene().add(Box{{2, 4, 6}}, at(5)));
    EXPECT_NEAR(cast_one(forward).range_m, 4.0, range_tolerance_m);
    EXPECT_NEAR(cast_one(forward, at(5)).range_m, 1.0, range_tolerance_m);
    EXPECT_NEAR(cast_one(leftward, at(5)).range_m, 2.0, range_tolerance_m);
}

TEST_P(BackendContract, ReportsNothingBeyondTheMaximum) {
    load(scene().add(Plane{{10, 10}}, wall_at(5)).add(Plane{{10, 10}}, wall_at(8)));
    EXPECT_NEAR(cast_one(forward, {}, 5.01F).range_m, 5.0, range_tolerance_m);
    expect_nothing(cast_one(forward, {}, 4.99F));
    expect_nothing(cast_one(forward, {}, 0.0F));
}

TEST_P(BackendContract, MovesWhatIsMovable) {
    load(scene().add(Plane{{20, 20}}, wall_at(10), 1).movable(at(3)).with(Box{{1, 1, 1}}, {}, 2));
    EXPECT_NEAR(cast_one(forward).range_m, 2.5, range_tolerance_m);
    move(1, at(6));
    const Hit hit = cast_one(forward);
    EXPECT_NEAR(hit.range_m, 5.5, range_tolerance_m);
    EXPECT_EQ(hit.object, 1U);
    EXPECT_EQ(hit.material, 2U);
    move(1, at(6, 5));
    EXPECT_EQ(cast_one(forward).object, 0U);
    EXPECT_NEAR(cast_one(forward).range_m, 10.0, range_tolerance_m);
    move(1, at(12));  // behind the wall
    EXPECT_EQ(cast_one(forward).object, 0U);
}

TEST_P(BackendContract, TurnsWhatIsMovable) {
    load(scene().add(Plane{{20, 20}}, wall_at(10)).movable({}).with(Plane{{4, 4}}, {}));
    for (const double yaw_rad : {0.0, 0.3, -1.0, 2.5}) {
        move(1, at(3) * yawed(yaw_rad) * wall_at(0));
        const Hit hit = cast_one(forward);
        EXPECT_EQ(hit.object, 1U);
        EXPECT_NEAR(hit.range_m, 3.0, range_tolerance_m);
        EXPECT_NEAR(hit.cos_incidence, std::abs(std::cos(yaw_rad)), cos_tolerance);
    }
}

TEST_P(BackendContract, MovesAllObjectsOfAModelAndNoOther) {
    load(scene()
             .movable(at(0, -2))
             .with(Box{{1, 1, 1}}, at(0, 0, 0))
             .with(Sphere{0.5}, at(0, 0, 2))
             .movable(at(0, 2))
             .with(Box{{1, 1, 1}}, at(0, 0, 0)));
    move(0, at(8, -2));
    EXPECT_NEAR(cast_one(forward, at(-4, -2, 0)).range_m, 11.5, range_tolerance_m);
    EXPECT_NEAR(cast_one(forward, at(-4, -2, 2)).range_m, 11.5, range_tolerance_m);
    EXPECT_EQ(cast_one(forward, at(-4, -2, 2)).object, 1U);
    EXPECT_NEAR(cast_one(forward, at(-4, 2, 0)).range_m, 3.5, range_tolerance_m);
    EXPECT_EQ(cast_one(forward, at(-4, 2, 0)).object, 2U);
}

TEST_P(BackendContract, PlacesObjectsInTheirModels) {
    load(scene().movable(at(5) * yawed(std::numbers::pi / 2)).with(Box{{1, 1, 1}}, at(0, 2)));
    // The model's left is our back: the box is 2 m nearer than the model.
    EXPECT_NEAR(cast_one(forward).range_m, 2.5, range_tolerance_m);
}

TEST_P(BackendContract, HoldsToTheMaximumForMovablesToo) {
    load(scene().movable(at(5)).with(Box{{1, 1, 1}}, {}));
    EXPECT_TRUE(cast_one(forward, {}, 4.51F).met());
    expect_nothing(cast_one(forward, {}, 4.49F));
}

// A sensor within a body of two pieces, with another robot's body ahead and a wall behind that.
TEST_P(BackendContract, LooksThroughTheBodyThatCarriesTheSensorAndNoOther) {
    load(scene()
             .add(Plane{{20, 20}}, wall_at(10))
             .movable({})
             .with(Sphere{0.5}, {})
             .with(Box{{1, 1, 1}}, at(2))
             .movable(at(6))
             .with(Box{{1, 1, 1}}, {}));
    const auto ahead = [&](ModelId unseen) {
        return cast({forward}, {Pose{}}, nothing, unseen).front();
    };
    EXPECT_NEAR(ahead(no_model).range_m, 0.5, range_tolerance_m);
    EXPECT_NEAR(ahead(1).range_m, 5.5, range_tolerance_m);
    EXPECT_EQ(ahead(1).object, 3U);
    EXPECT_NEAR(ahead(2).range_m, 0.5, range_tolerance_m);
    move(2, at(6, 5));
    EXPECT_NEAR(ahead(1).range_m, 10.0, range_tolerance_m);
    EXPECT_EQ(ahead(1).object, 0U);
}

// A sensor within its housing, a sphere, with a post of the same body, another body, a shell that
// stands still and a wall around it.
TEST_P(BackendContract, LooksThroughSingleObjectsOfAnyModel) {
    load(scene()
             .add(Plane{{20, 20}}, wall_at(10))
             .add(Box{{0.5, 0.5, 0.5}}, Pose{})
             .movable({})
             .with(Sphere{0.1}, {})
             .with(Box{{0.2, 0.2, 2}}, at(0, 2))
             .movable(at(6))
             .with(Box{{1, 1, 1}}, {}));
    const std::vector<glm::vec3> around{forward, {0, 1, 0}, {-1, 0, 0}};
    const auto met = [&](std::vector<ObjectId> unseen) {
        std::vector<Hit> hits = cast(around, {Pose{}}, nothing, {no_model, unseen});
        return hits;
    };
    EXPECT_NEAR(met({}).front().range_m, 0.1, range_tolerance_m);
    for (const Hit& hit : met({2}))
        EXPECT_NEAR(hit.range_m, 0.25, range_tolerance_m);
    const std::vector<Hit> hits = met({1, 2});
    EXPECT_NEAR(hits[0].range_m, 5.5, range_tolerance_m);
    EXPECT_EQ(hits[0].object, 4U);
    EXPECT_NEAR(hits[0].cos_incidence, 1.0, 1e-3);
    EXPECT_NEAR(hits[1].range_m, 1.9, range_tolerance_m);
    EXPECT_EQ(hits[1].object, 3U);
    EXPECT_FALSE(hits[2].met());
    move(3, at(6, 5));
    EXPECT_NEAR(met({1, 2})[0].range_m, 10.0, range_tolerance_m);
    EXPECT_EQ(met({1, 2})[0].object, 0U);
}

// Robots of one kind: the same two pieces each, of other materials. The last is of another size.
TEST_P(BackendContract, TellsBodiesOfEqualGeometryApart) {
    load(scene()
             .movable(at(5))
             .with(Box{{1, 1, 1}}, {}, 1)
             .with(Sphere{0.4}, at(0, 2), 2)
             .movable(at(-7))
             .with(Box{{1, 1, 1}}, {}, 3)
             .with(Sphere{0.4}, at(0, 2), 1)
             .movable(at(0, 4))
             .with(Box{{1, 1, 1.5}}, {}, 2));
    const auto expect = [&](const glm::vec3& direction, float range_m, ObjectId object,
                            MaterialId material) {
        const Hit hit = cast_one(direction);
        EXPECT_NEAR(hit.range_m, range_m, range_tolerance_m);
        EXPECT_EQ(hit.object, object);
        EXPECT_EQ(hit.material, material);
    };
    expect({1, 0, 0}, 4.5F, 0, 1);
    expect({-1, 0, 0}, 6.5F, 2, 3);
    expect({0, 1, 0}, 3.5F, 4, 2);
    move(1, at(-7, -2));
    expect({-1, 0, 0}, 6.6F, 3, 1);
    move(1, at(3));
    expect({1, 0, 0}, 2.5F, 2, 3);
    move(1, at(9));
    expect({1, 0, 0}, 4.5F, 0, 1);
}

TEST_P(BackendContract, MeetsWhatMovesWhetherTheOthersAreLookedForOrNot) {
    load(scene()
             .add(Plane{{20, 20}}, wall_at(10))
             .movable(at(5))
             .with(Box{{1, 1, 1}}, {})
             .movable(at(0, 5))
             .with(Box{{1, 1, 1}}, {}));
    const auto seen_ahead = [&](std::vector<ModelId> can_meet) {
        return cast({forward}, {Pose{}}, nothing, no_model, can_meet).front();
    };
    EXPECT_EQ(seen_ahead({1}).object, 1U);
    // While nobody looks for it, the other one comes to stand ahead.
    move(1, at(5, 5));
    move(2, at(3));
    EXPECT_EQ(seen_ahead({2}).object, 2U);
    EXPECT_NEAR(seen_ahead({2, 1}).range_m, 2.5, range_tolerance_m);
    move(2, at(3, 3));
    EXPECT_EQ(seen_ahead({}).object, 0U);
    move(1, at(4));
    EXPECT_NEAR(cast_one(forward).range_m, 3.5, range_tolerance_m);
    EXPECT_EQ(cast_one(forward).object, 1U);
}

// The cosine of a quarter turn comes out as 1e-17, and not as 0.
TEST_P(BackendContract, SeesWhatIsAtRightAnglesOfASensorThatIsTilted) {
    SceneBuilder walls = scene();
    for (int i = -20; i <= 20; ++i)
        walls.add(Box{{1, 0.1, 3}}, at(i, 5)).add(Box{{1, 0.1, 3}}, at(i, -5));
    load(walls);
    std::vector<glm::vec3> directions;
    for (int i = -540; i <= 540; ++i) {
        const double angle_rad = i * std::numbers::pi / 720;
        directions.emplace_back(std::cos(angle_rad), std::sin(angle_rad), 0.0);
    }
    for (const double pitch_rad : {0.0, 0.001, 0.005, -0.003}) {
        const auto hits = cast(directions, {pose_from_rpy({0.2, 0, 0}, {0, pitch_rad, 0})});
        for (int i = -380; i <= -340; ++i) {
            EXPECT_TRUE(hits[540 + i].met()) << "pitch " << pitch_rad;
            EXPECT_TRUE(hits[540 - i].met()) << "pitch " << pitch_rad;
        }
    }
}

// As of a scanner at the height of the ground, where a robot's frame is. Far away the two are not
// in one plane to the last bit.
TEST_P(BackendContract, DoesNotMeetTheFaceThatItLiesIn) {
    if (std::get<1>(GetParam()) == Place::far_away) GTEST_SKIP();
    load(scene().add(Plane{{40, 40}}, Pose{}).add(Box{{2, 20, 2}}, at(4)));
    std::vector<glm::vec3> directions;
    for (int i = -200; i <= 200; ++i) {
        const double angle_rad = i * std::numbers::pi / 720;
        directions.emplace_back(std::cos(angle_rad), std::sin(angle_rad), 0.0);
    }
    for (const double yaw_rad : {0.0, 0.1, -0.3}) {
        const auto hits = cast(directions, {pose_from_rpy({0, 0, 0}, {0, 0, yaw_rad})});
        for (int i = -200; i <= 200; ++i) {
            const double range_m = 3.0 / std::cos(i * std::numbers::pi / 720 + yaw_rad);
            EXPECT_NEAR(hits[200 + i].range_m, range_m, range_tolerance_m) << i;
        }
    }
}

TEST_P(BackendContract, HasNoGapWhereFacesMeet) {
    load(scene().add(Box{{10, 10, 10}}, Pose{}));
    std::vector<glm::vec3> at_edges;
    for (int i = 0; i <= 1000; ++i) {
        const auto along = static_cast<float>(-5.0 + 0.01 * i);
        at_edges.push_back(glm::normalize(glm::vec3{5, 5, along}));
        at_edges.push_back(glm::normalize(glm::vec3{along, 5, -5}));
        at_edges.push_back(glm::normalize(glm::vec3{-5, along, along}));  // a diagonal of a face
    }
    for (const Hit& hit : cast(at_edges, {Pose{}}))
        EXPECT_TRUE(hit.met());
}

}  // namespace
}  // namespace scipd::sim
