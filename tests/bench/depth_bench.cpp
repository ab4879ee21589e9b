// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Measures what a depth buffer costs in the maze, in turns with each of three yardsticks:
//
//   bare     the same strips drawn and read back, with their triangles selected beforehand
//   whole    the same strips with the whole scene drawn in each of them
//   rays     the same directions through Embree
//
// strips: a UST-10LX, 1081 beams over 270 degrees. camera: n x n pixels over 90 degrees. runs: a
// moving UST-10LX; its sweep is cut into this many pieces, each with its own pose.
#include <cmath>
#include <numbers>
#include <vector>

#include <benchmark/benchmark.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "sim/backends/registry.h"
#include "tests/bench/bare_depth.h"
#include "tests/bench/maze.h"
#include "tests/bench/rounds.h"

namespace scipd::sim {
namespace {

constexpr std::size_t scans = 32;
constexpr float max_range_m = 60.0F;

using Directions = std::vector<glm::vec3>;

Directions ust_10lx() {
    Directions directions;
    for (int step = -540; step <= 540; ++step) {
        const double angle_rad = step * std::numbers::pi / 720;
        directions.emplace_back(std::cos(angle_rad), std::sin(angle_rad), 0.0);
    }
    return directions;
}

Directions camera(int side) {
    Directions directions;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            directions.emplace_back(glm::normalize(
                glm::dvec3{1.0, 1.0 - (2.0 * x + 1.0) / side, 1.0 - (2.0 * y + 1.0) / side}));
        }
    }
    return directions;
}

/// One pose for each direction in each scan, `runs` of them different. The robot drives at 2 m/s
/// and turns at 3 rad/s.
std::vector<std::vector<Pose>> sweeps(std::size_t directions, std::size_t runs) {
    std::vector<std::vector<Pose>> all;
    for (const Pose& pose : maze_poses(scans)) {
        std::vector<Pose>& sweep = all.emplace_back();
        for (std::size_t i = 0; i < directions; ++i) {
            const double passed_s = 0.025 * double(i * runs / directions) / double(runs);
            sweep.push_back(pose * pose_from_rpy({2.0 * passed_s, 0, 0}, {0, 0, 3.0 * passed_s}));
        }
    }
    return all;
}

void compare(benchmark::State& state, const Directions& directions, std::size_t runs) {
    const SharedScene scene = maze();
    const auto depth = make_backend("depth", scene);
    const auto rays = make_backend("embree", scene);
    const auto poses = sweeps(directions.size(), runs);
    const DepthPlan plan({directions, poses.front()}, {});
    using Drawn = BareDepth::Drawn;
    BareDepth bare(*scene, plan.views(), plan.pictures().front().size_px, poses, Drawn::seen);
    const bool draw_whole = runs <= 10;  // with a thousand it would draw millions of triangles
    BareDepth whole(*scene, plan.views(), plan.pictures().front().size_px,
                    draw_whole ? poses : std::vector<std::vector<Pose>>{}, Drawn::whole);
    std::vector<Hit> hits(directions.size());
    std::vector<double> depth_s;
    std::vector<double> bare_s;
    std::vector<double> whole_s;
    std::vector<double> rays_s;
    std::size_t scan = 0;
    const auto round_of = [&](std::size_t other) {
        const Fan fan{directions, poses[scan], max_range_m};
        depth_s.push_back(seconds_for([&] { depth->cast(fan, hits); }));
        bare_s.push_back(seconds_for([&] { bare.draw_and_read(other); }));
        if (draw_whole) whole_s.push_back(seconds_for([&] { whole.draw_and_read(other); }));
        rays_s.push_back(seconds_for([&] { rays->cast(fan, hits); }));
    };
    round_of(0);  // only warms up
    for (std::vector<double>* times : {&depth_s, &bare_s, &whole_s, &rays_s})
        times->clear();
    for ([[maybe_unused]] auto round : state) {
        round_of((scan + scans / 2) % scans);
        state.SetIterationTime(depth_s.back());
        scan = (scan + 1) % scans;
    }
    state.counters["us"] = 1e6 * median(depth_s);
    state.counters["to_bare"] = median(depth_s) / median(bare_s);
    if (draw_whole) state.counters["to_whole"] = median(depth_s) / median(whole_s);
    state.counters["to_rays"] = median(depth_s) / median(rays_s);
}

void strips(benchmark::State& state) {
    compare(state, ust_10lx(), 1);
}

void camera(benchmark::State& state) {
    compare(state, camera(static_cast<int>(state.range(0))), 1);
}

void runs(benchmark::State& state) {
    compare(state, ust_10lx(), static_cast<std::size_t>(state.range(0)));
}

BENCHMARK(strips)->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(1000);
BENCHMARK(camera)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond)
    ->Iterations(500)
    ->Arg(35)
    ->Arg(100)
    ->Arg(200);
BENCHMARK(runs)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond)
    ->Iterations(32)
    ->Arg(1)
    ->Arg(3)
    ->Arg(10)
    ->Arg(30)
    ->Arg(100)
    ->Arg(300)
    ->Arg(1081);

}  // namespace
}  // namespace scipd::sim

BENCHMARK_MAIN();
