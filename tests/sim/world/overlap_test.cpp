// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Rays that are shot at random count the boxes on their way: what worst_overlap() tells by areas.
#include "sim/world/overlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/support/scene_builder.h"

namespace scipd::sim {
namespace {

using Random = std::mt19937;

glm::vec3 somewhere(Random& random, float half_m) {
    std::uniform_real_distribution<float> at_m(-half_m, half_m);
    return {at_m(random), at_m(random), at_m(random)};
}

/// Triangles of about this size whose middles lie in a cube.
Mesh soup(int triangles, float half_cube_m, float half_size_m, const glm::vec3& middle_m = {}) {
    Random random(7);
    Mesh mesh;
    for (int i = 0; i < triangles; ++i) {
        const auto first = static_cast<glm::uint>(mesh.vertices_m.size());
        const glm::vec3 at_m = middle_m + somewhere(random, half_cube_m);
        for (int corner = 0; corner < 3; ++corner)
            mesh.vertices_m.push_back(at_m + somewhere(random, half_size_m));
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    return mesh;
}

/// A surface of hills, without gaps: two triangles a field.
Mesh hills(glm::uint fields) {
    Mesh mesh;
    for (glm::uint row = 0; row <= fields; ++row) {
        for (glm::uint column = 0; column <= fields; ++column) {
            const float x_m = 0.1F * float(column);
            const float y_m = 0.1F * float(row);
            mesh.vertices_m.emplace_back(x_m, y_m, std::sin(x_m) * std::cos(y_m));
        }
    }
    for (glm::uint row = 0; row < fields; ++row) {
        for (glm::uint column = 0; column < fields; ++column) {
            const glm::uint corner = row * (fields + 1) + column;
            mesh.triangles.emplace_back(corner, corner + 1, corner + fields + 1);
            mesh.triangles.emplace_back(corner + 1, corner + fields + 2, corner + fields + 1);
        }
    }
    return mesh;
}

SharedMesh shared(Mesh mesh) {
    return std::make_shared<const Mesh>(std::move(mesh));
}

Mesh both(Mesh one, const Mesh& other) {
    const auto first = static_cast<glm::uint>(one.vertices_m.size());
    one.vertices_m.insert(one.vertices_m.end(), other.vertices_m.begin(), other.vertices_m.end());
    for (const glm::uvec3& triangle : other.triangles)
        one.triangles.push_back(triangle + first);
    return one;
}

std::optional<Overlap> worst(const SceneBuilder& builder, double most = 1000) {
    const SharedScene scene = builder.build();
    return worst_overlap(*scene, *scene, most);
}

bool goes_through(const glm::vec3& from_m, const glm::vec3& along, const glm::vec3& low_m,
                  const glm::vec3& high_m) {
    const glm::vec3 a = (low_m - from_m) / along;
    const glm::vec3 b = (high_m - from_m) / along;
    const glm::vec3 in = glm::min(a, b);
    const glm::vec3 out = glm::max(a, b);
    return std::max({in.x, in.y, in.z}) <= std::min({out.x, out.y, out.z});
}

/// On average, of rays with any direction that go through the box around all: such a ray goes
/// through a point of a sphere around it.
double boxes_on_the_way(const Mesh& mesh) {
    std::vector<std::array<glm::vec3, 2>> boxes;
    glm::vec3 low_m{1e9F};
    glm::vec3 high_m{-1e9F};
    for (const glm::uvec3& triangle : mesh.triangles) {
        const glm::vec3 &a = mesh.vertices_m[triangle.x], &b = mesh.vertices_m[triangle.y],
                        &c = mesh.vertices_m[triangle.z];
        boxes.push_back({glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))});
        low_m = glm::min(low_m, boxes.back()[0]);
        high_m = glm::max(high_m, boxes.back()[1]);
    }
    const glm::vec3 middle_m = 0.5F * (low_m + high_m);
    const float radius_m = glm::distance(high_m, middle_m);
    Random random(3);
    std::normal_distribution<float> normal;
    const auto on_sphere = [&] {
        const glm::vec3 any{normal(random), normal(random), normal(random)};
        return middle_m + radius_m * glm::normalize(any);
    };
    int rays = 0;
    double met = 0.0;
    // A chord between two points of a sphere is a ray of any direction and place (Cauchy).
    while (rays < 3000) {
        const glm::vec3 from_m = on_sphere();
        const glm::vec3 along = on_sphere() - from_m;
        if (!goes_through(from_m, along, low_m, high_m)) continue;
        ++rays;
        for (const auto& [low, high] : boxes)
            met += goes_through(from_m, along, low, high) ? 1.0 : 0.0;
    }
    return met / rays;
}

TEST(WorstOverlap, IsWhatRaysMeet) {
    const Mesh cloud = soup(4000, 0.5F, 0.5F);
    const double met = boxes_on_the_way(cloud);
    ASSERT_GT(met, 200.0);
    const auto found = worst(SceneBuilder{}.add(shared(cloud), {}), 150);
    ASSERT_TRUE(found);
    // The middle of the cloud is denser than the whole.
    EXPECT_GT(found->triangles, 0.95 * met);
    EXPECT_LT(found->triangles, 2.0 * met);
}

TEST(WorstOverlap, OfOneTriangleAgainAndAgainIsAllOfThem) {
    const Pose ahead = pose_from_rpy({30, 20, 10}, {0, 0, 0.3});
    const auto found = worst(SceneBuilder{}
                                 .add(shared(soup(1, 1, 1)), {})
                                 .add(shared([] {
                                          Mesh mesh = soup(1, 0, 1);
                                          mesh.triangles.resize(5000, mesh.triangles.front());
                                          return mesh;
                                      }()),
                                      ahead));
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->triangles, 5000, 1);
    EXPECT_EQ(found->object, "object 1");
    EXPECT_LT(glm::distance(found->middle_m, ahead.translation_m), 2.0);
}

TEST(WorstOverlap, IsSmallWhereTrianglesLieBesideEachOther) {
    EXPECT_FALSE(worst(SceneBuilder{}.add(shared(hills(300)), {}), 100));
    EXPECT_FALSE(worst(SceneBuilder{}.add(shared(soup(200'000, 5.0F, 0.02F)), {}), 100));
    EXPECT_FALSE(worst(SceneBuilder{}.add(Sphere{2}, {}).add(Box{{1, 1, 1}}, {}), 100));
    SceneBuilder store;
    for (int i = 0; i < 30'000; ++i)
        store.add(Box{{0.5, 0.5, 0.5}}, pose_from_rpy({i % 200, i / 200, 0}, {0, 0, 0.1 * i}));
    EXPECT_FALSE(worst(store, 100));
}

TEST(WorstOverlap, IsFoundInTheMidstOfMuchElse) {
    const glm::vec3 place_m{4.03F, 5.07F, 1};
    const auto found = worst(
        SceneBuilder{}.add(shared(both(hills(400), soup(8000, 0.0001F, 0.01F, place_m))), {}));
    ASSERT_TRUE(found);
    EXPECT_LT(glm::distance(found->middle_m, glm::dvec3{place_m}), 0.1);
}

TEST(WorstOverlap, CountsShapesOfManyObjectsTogether) {
    SceneBuilder still;
    for (int i = 0; i < 2000; ++i)
        still.add(Box{{1, 1, 1}}, pose_from_rpy({0, 0, 1e-4 * i}, {0, 0, 0}));
    EXPECT_TRUE(worst(still));
    SceneBuilder body;
    body.movable({{0, 0, 5}, {1, 0, 0, 0}});
    for (int i = 0; i < 2000; ++i)
        body.with(Sphere{1}, {});
    const auto found = worst(body);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->middle_m.z, 5.0, 1e-3);
}

// Robots of one kind may well begin at one place.
TEST(WorstOverlap, CountsWhatMovesByItself) {
    const SharedMesh body = shared(soup(900, 0.01F, 0.5F));
    SceneBuilder robots;
    for (int i = 0; i < 20; ++i)
        robots.movable({}).with(body, {});
    EXPECT_FALSE(worst(robots, 400));
    robots.movable({}).with(body, {}).with(body, {});
    EXPECT_TRUE(worst(robots, 400));
}

TEST(WorstOverlap, LooksWhereSomethingWasAdded) {
    SceneBuilder world;
    world.add(shared(soup(900, 0.01F, 0.5F)), {});
    const SceneBuilder beside = SceneBuilder{}.add(Box{{1, 1, 1}}, {{9, 9, 9}, {1, 0, 0, 0}});
    const SceneBuilder within = SceneBuilder{}.add(shared(soup(900, 0.01F, 0.5F)), {});
    const auto worst_with = [&](const SceneBuilder& added) {
        const SharedScene more = added.build();
        Scene renamed = *more;
        renamed.models.front().name = "added";
        return worst_overlap(*with_models(*world.build(), renamed), renamed, 400);
    };
    EXPECT_FALSE(worst_with(beside));
    EXPECT_TRUE(worst_with(within));
}

}  // namespace
}  // namespace scipd::sim
