// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Backends for the same scene, on one thread or on several, share what takes most of their memory.
#include <array>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "sim/backends/embree.h"
#include "sim/world/shape.h"
#include "tests/support/sanitized.h"
#include "tests/support/scene_builder.h"

namespace scipd::sim {
namespace {

double resident_mb() {
    std::ifstream statm("/proc/self/statm");
    double all = 0;
    double resident = 0;
    statm >> all >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

/// A square of 30 m by 30 m with waves, and a ball that can move. `side`: squares along an edge.
SharedScene sea(unsigned side) {
    auto mesh = std::make_shared<Mesh>();
    for (unsigned y = 0; y <= side; ++y) {
        for (unsigned x = 0; x <= side; ++x) {
            const float wave = 0.1F * static_cast<float>((x * 7 + y * 13) % 5);
            mesh->vertices_m.emplace_back(30.0F * float(x) / float(side) - 15.0F,
                                          30.0F * float(y) / float(side) - 15.0F, wave - 2.0F);
        }
    }
    for (unsigned y = 0; y < side; ++y) {
        for (unsigned x = 0; x < side; ++x) {
            const unsigned corner = y * (side + 1) + x;
            mesh->triangles.emplace_back(corner, corner + 1, corner + side + 1);
            mesh->triangles.emplace_back(corner + 1, corner + side + 2, corner + side + 1);
        }
    }
    return SceneBuilder()
        .add(SharedMesh(mesh), {})
        .movable({{3, 0, 0}, {1, 0, 0, 0}})
        .with(Sphere{0.5}, {})
        .build();
}

std::vector<float> ranges(RangeBackend& backend, double ball_at_m) {
    backend.move(1, {{ball_at_m, 0, 0}, {1, 0, 0, 0}});
    std::vector<glm::vec3> directions;
    for (int i = 0; i < 500; ++i)
        directions.push_back(glm::normalize(glm::vec3(1.0F, 0.002F * float(i - 250), -0.2F)));
    directions.front() = {1, 0, 0};
    const std::array pose{Pose{}};
    std::vector<Hit> hits(directions.size());
    backend.cast({.directions = directions, .world_from_sensor = pose}, hits);
    std::vector<float> ranges_m;
    for (const Hit& hit : hits)
        ranges_m.push_back(hit.range_m);
    return ranges_m;
}

TEST(EmbreeOfOneScene, TakesTheMemoryOfWhatStandsStillOnce) {
    if (tests::sanitized) GTEST_SKIP() << tests::sanitizers_want_memory;
    const SharedScene scene = sea(500);
    const double before_mb = resident_mb();
    const auto first = make_embree_backend(scene);
    const double with_one_mb = resident_mb();
    const auto second = make_embree_backend(scene);
    const double with_two_mb = resident_mb();
    EXPECT_GT(with_one_mb - before_mb, 30.0) << "too small a world to tell anything";
    EXPECT_LT(with_two_mb - with_one_mb, 0.2 * (with_one_mb - before_mb));
}

/// Robots that all have this body. Without one, each has a box of its own height.
SharedScene many_robots(unsigned robots, const SharedMesh& body) {
    SceneBuilder scene;
    for (unsigned i = 0; i < robots; ++i) {
        scene.movable({{2.0 * i, 0, 0}, {1, 0, 0, 0}});
        if (body) {
            scene.with(body, {});
        } else {
            scene.with(Box{{1.0, 1.0, 1.0 + 1e-4 * i}}, {});
        }
    }
    return scene.build();
}

double backend_mb(const SharedScene& scene) {
    const double before_mb = resident_mb();
    const auto backend = make_embree_backend(scene);
    return resident_mb() - before_mb;
}

TEST(EmbreeOfOneScene, TakesTheMemoryOfEqualBodiesOnce) {
    if (tests::sanitized) GTEST_SKIP() << tests::sanitizers_want_memory;
    const auto body = std::get<SharedMesh>(sea(200)->objects.front().shape);
    const auto triangles_mb = 1e-6 * sizeof(glm::uvec3) * double(body->triangles.size());
    constexpr unsigned robots = 100;
    EXPECT_LT(backend_mb(many_robots(robots, body)), 0.5 * robots * triangles_mb);
}

TEST(EmbreeOfOneScene, TakesNoMoreForABodyWhereThereAreMany) {
    if (tests::sanitized) GTEST_SKIP() << tests::sanitizers_want_memory;
    EXPECT_LT(backend_mb(many_robots(5000, nullptr)), 0.03 * 5000);
}

TEST(EmbreeOfOneScene, HasWhatMovesForEachBackend) {
    const SharedScene scene = sea(20);
    auto first = make_embree_backend(scene);
    const auto near = ranges(*first, 3.0);
    EXPECT_NEAR(near.front(), 2.5, 1e-3);
    const auto second = make_embree_backend(scene);
    EXPECT_NEAR(ranges(*second, 7.0).front(), 6.5, 1e-3);
    EXPECT_EQ(ranges(*first, 3.0), near);
    first.reset();
    EXPECT_EQ(ranges(*second, 3.0), near);
}

TEST(EmbreeOfOneScene, IsCastIntoByManyThreads) {
    const SharedScene scene = sea(100);
    const auto expected = ranges(*make_embree_backend(scene), 3.0);
    std::vector<int> same(4);
    std::vector<std::thread> threads;
    for (int& count : same) {
        threads.emplace_back([&] {
            for (int made = 0; made < 4; ++made) {
                const auto backend = make_embree_backend(scene);
                for (int i = 0; i < 50; ++i) {
                    (void)ranges(*backend, 5.0 + i);
                    count += ranges(*backend, 3.0) == expected ? 1 : 0;
                }
            }
        });
    }
    for (std::thread& thread : threads)
        thread.join();
    EXPECT_EQ(same, std::vector<int>(4, 200));
}

}  // namespace
}  // namespace scipd::sim
