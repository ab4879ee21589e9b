// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Measures what it costs to move models, which are boxes above the maze. A step moves them and
// makes the scene ready to be cast into. Each round does a step with the backend and one with the
// bare calls of Embree. `ratio` compares the medians.
//
//   rays      Embree: moves all models
//   few       Embree: moves ten of the models
//   depth     depth buffer: moves all models. `next_scan_us` is the time of a scan of a UST-10LX
//             after the step, `same_scan_us` the time of the same scan if nothing has moved
//   rebuild   makes a new backend for the scene with the models elsewhere, instead of a step
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x3.hpp>

#include "sim/backends/registry.h"
#include "tests/bench/bare_embree.h"
#include "tests/bench/maze.h"
#include "tests/bench/rounds.h"

namespace scipd::sim {
namespace {

constexpr std::size_t steps = 8;  // repeated
constexpr double flying_m = 2.0;  // above everything else
constexpr double box_m = 0.4;
constexpr float max_range_m = 60.0F;

/// Poses by step and model.
using Moves = std::vector<std::vector<Pose>>;

Moves moves_of(std::size_t models) {
    std::mt19937 rng(8);
    const auto uniform = [&](double high) {
        return std::uniform_real_distribution<double>(0, high)(rng);
    };
    Moves moves(steps);
    for (std::vector<Pose>& step : moves) {
        for (std::size_t i = 0; i < models; ++i) {
            step.push_back(pose_from_rpy({uniform(maze_m), uniform(maze_m), flying_m},
                                         {0, 0, uniform(2.0 * std::numbers::pi)}));
        }
    }
    return moves;
}

/// The boxes as bare instances in a scene of their own.
class BareInstances {
  public:
    explicit BareInstances(std::size_t models) {
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        const Mesh box = tessellate(Box{{box_m, box_m, box_m}});
        for (std::size_t i = 0; i < models; ++i)
            add(box);
    }
    BareInstances(const BareInstances&) = delete;
    BareInstances& operator=(const BareInstances&) = delete;
    ~BareInstances() {
        for (RTCGeometry instance : instances_)
            rtcReleaseGeometry(instance);
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }

    void move(std::size_t model, const Pose& pose, const glm::dvec3& anchor_m) {
        const glm::mat3 rotation{glm::mat3_cast(pose.rotation)};
        const glm::mat4x3 transform{rotation[0], rotation[1], rotation[2],
                                    glm::vec3{pose.translation_m - anchor_m}};
        rtcSetGeometryTransform(instances_[model], 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR,
                                glm::value_ptr(transform));
        rtcCommitGeometry(instances_[model]);
    }
    void commit() { rtcCommitScene(scene_); }

  private:
    void add(const Mesh& mesh) {
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        std::ranges::copy(mesh.vertices_m,
                          static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
                              geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              sizeof(glm::vec3), mesh.vertices_m.size())));
        std::ranges::copy(mesh.triangles, static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
                                              geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              sizeof(glm::uvec3), mesh.triangles.size())));
        rtcCommitGeometry(geometry);
        RTCScene body = rtcNewScene(device_);
        rtcSetSceneFlags(body, RTC_SCENE_FLAG_ROBUST);
        rtcAttachGeometry(body, geometry);
        rtcCommitScene(body);
        RTCGeometry instance = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(instance, body);
        rtcAttachGeometry(scene_, instance);
        instances_.push_back(instance);
        rtcReleaseScene(body);
        rtcReleaseGeometry(geometry);
    }

    RTCDevice device_ = rtcNewDevice("threads=1");
    RTCScene scene_ = rtcNewScene(device_);
    std::vector<RTCGeometry> instances_;
};

void move(RangeBackend& backend, std::span<const Pose> poses) {
    for (ModelId model = 0; model < poses.size(); ++model)
        backend.move(model, poses[model]);
}

/// Casts nothing, but makes everything ready for it.
void make_ready(RangeBackend& backend) {
    const Pose anywhere;
    backend.cast({{}, {&anywhere, 1}, max_range_m}, {});
}

/// Looks down on each box from above, where nothing is in the way.
bool all_are_there(RangeBackend& backend, std::span<const Pose> poses) {
    const std::vector<glm::vec3> ahead{{1, 0, 0}};
    std::vector<Hit> hits(1);
    for (const Pose& pose : poses) {
        Pose above = pose_from_rpy(pose.translation_m, {0, std::numbers::pi / 2, 0});
        above.translation_m.z += 5.0;
        backend.cast({ahead, {&above, 1}, max_range_m}, hits);
        if (std::abs(hits[0].range_m - (5.0 - box_m / 2)) > 1e-3) return false;
    }
    return true;
}

void step_by_rays(benchmark::State& state, std::size_t models, std::size_t moved) {
    const SharedScene scene = maze(models);
    const Moves moves = moves_of(models);
    const auto backend = make_backend("embree", scene);
    BareInstances bare(models);
    move(*backend, moves[1]);
    if (!all_are_there(*backend, moves[1])) return state.SkipWithError("a model has not moved");
    for (std::size_t i = 0; i < models; ++i)
        bare.move(i, moves[1][i], scene->anchor_m);
    std::vector<double> step_s, bare_s, moved_s;
    std::size_t step = 0;
    for ([[maybe_unused]] auto round : state) {
        const auto poses = std::span(moves[step]).first(moved);
        moved_s.push_back(seconds_for([&] { move(*backend, poses); }));
        step_s.push_back(moved_s.back() + seconds_for([&] { make_ready(*backend); }));
        bare_s.push_back(seconds_for([&] {
            for (std::size_t i = 0; i < poses.size(); ++i)
                bare.move(i, poses[i], scene->anchor_m);
            bare.commit();
        }));
        state.SetIterationTime(step_s.back());
        step = (step + 1) % steps;
    }
    state.counters["ratio"] = median(step_s) / median(bare_s);
    state.counters["us"] = 1e6 * median(step_s);
    state.counters["bare_us"] = 1e6 * median(bare_s);
    state.counters["change_ns"] = 1e9 * median(moved_s) / static_cast<double>(moved);
}

void rays(benchmark::State& state) {
    const auto models = static_cast<std::size_t>(state.range(0));
    step_by_rays(state, models, models);
}

void few(benchmark::State& state) {
    step_by_rays(state, static_cast<std::size_t>(state.range(0)), 10);
}

void depth(benchmark::State& state) {
    const auto models = static_cast<std::size_t>(state.range(0));
    const Moves moves = moves_of(models);
    const auto backend = make_backend("depth", maze(models));
    move(*backend, moves[1]);
    if (!all_are_there(*backend, moves[1])) return state.SkipWithError("a model has not moved");
    std::vector<glm::vec3> directions;
    for (int beam = -540; beam <= 540; ++beam) {
        const double angle_rad = beam * std::numbers::pi / 720;
        directions.emplace_back(std::cos(angle_rad), std::sin(angle_rad), 0.0);
    }
    std::vector<Hit> hits(directions.size());
    const Pose eye = maze_poses(1).front();
    const auto cast = [&] { backend->cast({directions, {&eye, 1}, max_range_m}, hits); };
    std::vector<double> moved_s, next_s, same_s;
    std::size_t step = 0;
    for ([[maybe_unused]] auto round : state) {
        moved_s.push_back(seconds_for([&] { move(*backend, moves[step]); }));
        next_s.push_back(seconds_for(cast));
        same_s.push_back(seconds_for(cast));
        state.SetIterationTime(moved_s.back());
        step = (step + 1) % steps;
    }
    state.counters["us"] = 1e6 * median(moved_s);
    state.counters["change_ns"] = 1e9 * median(moved_s) / static_cast<double>(models);
    state.counters["next_scan_us"] = 1e6 * median(next_s);
    state.counters["same_scan_us"] = 1e6 * median(same_s);
}

void rebuild(benchmark::State& state, const std::string& backend) {
    const SharedScene scene = maze(static_cast<std::size_t>(state.range(0)));
    std::vector<double> all_s;
    for ([[maybe_unused]] auto round : state) {
        std::unique_ptr<RangeBackend> built;
        all_s.push_back(seconds_for([&] { built = make_backend(backend, scene); }));
        state.SetIterationTime(all_s.back());
    }
    state.counters["us"] = 1e6 * median(all_s);
}

void rounds(benchmark::internal::Benchmark* bench) {
    bench->UseManualTime()->Unit(benchmark::kMicrosecond)->Arg(1)->Arg(10)->Arg(100)->Arg(1000);
}

BENCHMARK(rays)->Apply(rounds)->Iterations(2000);
BENCHMARK(few)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond)
    ->Iterations(2000)
    ->Arg(10)
    ->Arg(100)
    ->Arg(1000);
BENCHMARK_CAPTURE(rebuild, rays, "embree")->Apply(rounds)->Iterations(50);
#ifdef SCIPD_DEPTH
BENCHMARK(depth)->Apply(rounds)->Iterations(300);
BENCHMARK_CAPTURE(rebuild, depth, "depth")->Apply(rounds)->Iterations(20);
#endif

}  // namespace
}  // namespace scipd::sim

BENCHMARK_MAIN();
