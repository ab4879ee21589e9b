// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Measures one revolution of a UST-10LX in the rescue maze, from the poses of the sweep to the
// message for a client. It includes everything but the waiting and the socket.
//
//   build/release/bin/revolution_bench
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "daemon/clock/stepped_clock.h"
#include "daemon/device/device.h"
#include "daemon/faults/fault_injector.h"
#include "daemon/faults/read_fault.h"
#include "daemon/models/model_registry.h"
#include "daemon/world/world.h"
#include "sim/backends/registry.h"
#include "sim/loaders/scene_file.h"
#include "tests/support/one_backend.h"

namespace {

using namespace scipd;
using namespace std::chrono_literals;

daemon::SensorConfig scanner_config(sim::Accuracy accuracy) {
    daemon::SensorConfig config;
    config.name = "scanner";
    config.model = daemon::find_model("UST-10LX");
    config.robot_from_sensor = sim::pose_from_rpy({0, 0, 0.25}, {0, 0, 0});
    config.accuracy = accuracy;
    return config;
}

/// A pose at the start of the maze, turning at 1 rad/s.
sim::Pose turning_at(sim::Time time) {
    const double seconds = std::chrono::duration<double>(time).count();
    return sim::pose_from_rpy({1, 1, 0}, {0, 0, std::remainder(seconds, 2 * std::numbers::pi)});
}

constexpr int rows = 10;

std::string box_name(int box) {
    return "box_" + std::to_string(box);
}

/// Boxes all over the maze, rows of them, that go round in circles at half a metre a second.
sim::Pose circling_at(int box, sim::Time time) {
    const double angle_rad = 3.3 * std::chrono::duration<double>(time).count() + box;
    return sim::pose_from_rpy({0.5 + 0.9 * (box % rows) + 0.15 * std::cos(angle_rad),
                               0.5 + 0.9 * (box / rows) + 0.15 * std::sin(angle_rad), 0.4},
                              {0, 0, std::remainder(angle_rad, 2 * std::numbers::pi)});
}

sim::SharedScene maze_with(int boxes) {
    const sim::SharedScene maze = sim::load_scene(SCIPD_SCENES "/rescue_maze.sdf").scene;
    sim::Scene added;
    for (int box = 0; box < boxes; ++box) {
        added.models.push_back({box_name(box), true, circling_at(box, 0s)});
        added.objects.push_back(
            {box_name(box) + "::shape", sim::ModelId(box), {}, sim::Box{{0.2, 0.15, 0.8}}, 0});
    }
    return boxes == 0 ? maze : sim::with_models(*maze, added);
}

class Revolutions {
  public:
    explicit Revolutions(sim::Accuracy accuracy, int boxes = 0) : boxes_(boxes) {
        sim::SharedScene scene = maze_with(boxes);
        world_.replace_scene(scene, daemon::one_backend(scene));
        world_.set_robots({{"robot", {turning_at(0s)}}});
        device_.emplace("robot", scanner_config(accuracy), 1, world_, clock_);
        client_ = device_->connect([] {}, protocol::LinkKind::network);
        client_->receive("MD0000108000000\n");
        while (!client_->session().streaming()) {
            clock_.advance_to(client_->wake_at().value());
            client_->wake();
        }
        while (client_->session().next_action()) {
        }
        revolution_ = device_->next_revolution();
        // The stream begins with the first whole turn.
        while (turn() == 0) {
        }
    }

    void start_fault(const char* json) {
        injector_.emplace(*device_, std::vector<daemon::Port*>{}, daemon::LinkConfig{}, clock_);
        injector_->start(daemon::parse_fault(json).value(), 1);
    }

    void move(sim::Time time) {
        (void)world_.place_robot("robot", {time, turning_at(time)});
        for (int box = 0; box < boxes_; ++box)
            (void)world_.place_model(box_name(box), {time, circling_at(box, time)});
    }

    /// When the next revolution is complete.
    [[nodiscard]] sim::Time leaves() const { return device_->leaves(revolution_); }

    /// Completes a revolution. Returns how many bytes its message has.
    std::size_t turn() {
        clock_.advance_to(leaves());
        device_->turn_complete(revolution_++);
        std::size_t bytes = 0;
        while (const auto action = client_->session().next_action())
            bytes += std::get<protocol::Send>(*action).bytes.size();
        return bytes;
    }

  private:
    int boxes_;
    daemon::SteppedClock clock_;
    daemon::World world_;
    std::optional<daemon::Device> device_;
    std::unique_ptr<daemon::Endpoint::Client> client_;
    std::optional<daemon::FaultInjector> injector_;
    std::int64_t revolution_ = 0;
};

void run(benchmark::State& state, sim::Accuracy accuracy, bool moving,
         const char* fault = nullptr) {
    Revolutions revolutions(accuracy);
    if (fault != nullptr) revolutions.start_fault(fault);
    std::size_t bytes = 0;
    for (auto _ : state) {
        // Poses are 25 ms apart. The sweep lies between two of them.
        if (moving) revolutions.move(revolutions.leaves() + 1ms);
        bytes += revolutions.turn();
    }
    if (bytes / static_cast<std::size_t>(state.iterations()) < 3000) {
        state.SkipWithError("a scan is missing");
    }
}
BENCHMARK_CAPTURE(run, still_ideal, sim::Accuracy::ideal, false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(run, still_sensor, sim::Accuracy::sensor, false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(run, still_material, sim::Accuracy::material, false)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(run, moving_material, sim::Accuracy::material, true)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(run, moving_sensor, sim::Accuracy::sensor, true)->Unit(benchmark::kMicrosecond);

// Placing the boxes is not measured.
void run_among_boxes(benchmark::State& state) {
    Revolutions revolutions(sim::Accuracy::sensor, static_cast<int>(state.range(0)));
    std::size_t bytes = 0;
    for (auto _ : state) {
        state.PauseTiming();
        revolutions.move(revolutions.leaves() + 1ms);
        state.ResumeTiming();
        bytes += revolutions.turn();
    }
    if (bytes / static_cast<std::size_t>(state.iterations()) < 3000) {
        state.SkipWithError("a scan is missing");
    }
}
BENCHMARK(run_among_boxes)->Arg(0)->Arg(rows)->Arg(rows* rows)->Unit(benchmark::kMicrosecond);

// What a fault costs that waits, and one that acts. Without one nothing is measured that the cases
// above do not have: compare still_sensor with that of a version without faults.
BENCHMARK_CAPTURE(run, still_sensor_and_a_fault_waits, sim::Accuracy::sensor, false,
                  R"({"kind":"sums","at":{"scan":900000000}})")
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(run, still_sensor_and_a_fault_acts, sim::Accuracy::sensor, false,
                  R"({"kind":"sums"})")
    ->Unit(benchmark::kMicrosecond);

/// All rays of a revolution, and nothing else: what a revolution is measured by.
void cast_alone(benchmark::State& state, sim::Accuracy accuracy, bool moving) {
    const sim::SharedScene scene = sim::load_scene(SCIPD_SCENES "/rescue_maze.sdf").scene;
    const auto backend = sim::preferred_backend().make(scene, {});
    const sim::Scanner scanner(daemon::find_model("UST-10LX").optics, {.accuracy = accuracy});
    const auto beams = static_cast<std::size_t>(scanner.spec().beams());
    std::vector<sim::Pose> poses(moving ? beams : 1);
    for (std::size_t i = 0; i < poses.size(); ++i)
        poses[i] = turning_at(i * 17us) * scanner_config(accuracy).robot_from_sensor;
    std::vector<sim::Hit> hits(scanner.directions().size());
    for (auto _ : state) {
        backend->cast({.directions = scanner.directions(),
                       .world_from_sensor = poses,
                       .max_range_m = 30.0F,
                       .directions_per_pose = hits.size() / beams},
                      hits);
    }
    state.counters["rays"] = double(hits.size());
}
BENCHMARK_CAPTURE(cast_alone, still, sim::Accuracy::sensor, false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(cast_alone, moving, sim::Accuracy::sensor, true)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(cast_alone, still_material, sim::Accuracy::material, false)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(cast_alone, moving_material, sim::Accuracy::material, true)
    ->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
