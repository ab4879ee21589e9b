// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Measures what a scan costs in the maze: 1081 rays over 270 degrees, with range, incidence, object
// and material. Each round casts one scan with the backend and one with a bare loop of
// rtcIntersect16, so that other load on the machine affects both. They cast different scans,
// because the second one to cast the same scan would find warm caches. `ratio` compares the
// medians.
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>

#include "sim/backends/registry.h"
#include "sim/sensor/beam_pattern.h"
#include "sim/sensor/scanner.h"
#include "tests/bench/bare_embree.h"
#include "tests/bench/maze.h"
#include "tests/bench/rounds.h"

namespace scipd::sim {
namespace {

constexpr std::size_t scans = 64;
constexpr float max_range_m = 60.0F;

SensorSpec spec() {
    return {.steps_per_turn = 1440,
            .first_step = 0,
            .last_step = 1080,
            .front_step = 540,
            .scan_period = std::chrono::milliseconds(25),
            .max_range_m = max_range_m,
            .noise = {{0.0, 0.010, 0.0}, {10.0, 0.0, 0.01}}};
}

/// One pose for each scan, or one for each beam: the robot drives at 2 m/s and turns at 3 rad/s.
std::vector<std::vector<Pose>> sweeps(bool moving) {
    std::vector<std::vector<Pose>> all;
    for (const Pose& pose : maze_poses(scans)) {
        std::vector<Pose>& sweep = all.emplace_back();
        for (int beam = 0; beam < (moving ? spec().beams() : 1); ++beam) {
            const double passed_s = 0.025 * beam / 1440;
            sweep.push_back(pose * pose_from_rpy({2.0 * passed_s, 0, 0}, {0, 0, 3.0 * passed_s}));
        }
    }
    return all;
}

/// The maze, both ways to cast into it, and the buffers for one scan.
struct Stage {
    explicit Stage(bool moving, std::size_t movables = 0)
        : scene(maze(movables)),
          backend(make_backend("embree", scene)),
          bare(*scene),
          poses(sweeps(moving)) {}

    void cast(std::size_t scan) {
        backend->cast({pattern.directions(), poses[scan], max_range_m}, hits);
        benchmark::DoNotOptimize(hits.data());
    }
    void cast_bare(std::size_t scan) {
        bare.cast(pattern.directions(), poses[scan], max_range_m, bare_m);
        benchmark::DoNotOptimize(bare_m.data());
    }
    /// Whether the bare loop gives the same ranges.
    bool agree() {
        for (std::size_t scan = 0; scan < scans; ++scan) {
            cast(scan);
            cast_bare(scan);
            for (std::size_t i = 0; i < hits.size(); ++i) {
                if (std::abs(std::min(hits[i].range_m, max_range_m) - bare_m[i]) > 1e-4F)
                    return false;
            }
        }
        return true;
    }

    SharedScene scene;
    std::unique_ptr<RangeBackend> backend;
    BareEmbree bare;
    BeamPattern pattern{spec()};
    std::vector<std::vector<Pose>> poses;
    std::vector<Hit> hits = std::vector<Hit>(pattern.directions().size());
    std::vector<float> bare_m = std::vector<float>(pattern.directions().size());
};

/// Runs `measured` and the bare loop in turn.
template <typename Measured>
void compare(benchmark::State& state, Stage& stage, Measured measured) {
    if (!stage.agree()) return state.SkipWithError("the bare loop measures something else");
    std::vector<double> measured_s;
    std::vector<double> bare_s;
    std::size_t scan = 0;
    for ([[maybe_unused]] auto round : state) {
        measured_s.push_back(seconds_for([&] { measured(scan); }));
        bare_s.push_back(seconds_for([&] { stage.cast_bare((scan + scans / 2) % scans); }));
        state.SetIterationTime(measured_s.back());
        scan = (scan + 1) % scans;
    }
    state.counters["ratio"] = median(measured_s) / median(bare_s);
    state.counters["us"] = 1e6 * median(measured_s);
    state.counters["bare_us"] = 1e6 * median(bare_s);
}

void cast(benchmark::State& state, bool moving) {
    Stage stage(moving);
    compare(state, stage, [&](std::size_t scan) { stage.cast(scan); });
}

/// Ten models stand elsewhere in every scan. For the bare loop they stand still in its only scene.
void cast_among_movables(benchmark::State& state) {
    constexpr ModelId movables = 10;
    Stage stage(false, movables);
    compare(state, stage, [&](std::size_t scan) {
        for (ModelId model = 0; model < movables; ++model) {
            stage.backend->move(model, stage.poses[(scan + 7 * (model + 1)) % scans].front());
        }
        stage.cast(scan);
    });
}

void measure(benchmark::State& state, Accuracy accuracy) {
    Stage stage(false);
    const Scanner scanner(spec(), {accuracy, 1, 2});
    std::int64_t revolution = 0;
    compare(state, stage, [&](std::size_t scan) {
        benchmark::DoNotOptimize(
            scanner.measure(*stage.backend, revolution++, Time{}, stage.poses[scan]));
    });
}

void rounds(benchmark::internal::Benchmark* bench) {
    bench->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(20'000);
}

BENCHMARK_CAPTURE(cast, one_pose, false)->Apply(rounds);
BENCHMARK_CAPTURE(cast, pose_per_beam, true)->Apply(rounds);
BENCHMARK(cast_among_movables)->Apply(rounds);
BENCHMARK_CAPTURE(measure, ideal, Accuracy::ideal)->Apply(rounds);
BENCHMARK_CAPTURE(measure, sensor, Accuracy::sensor)->Apply(rounds);

}  // namespace
}  // namespace scipd::sim

BENCHMARK_MAIN();
