// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Builds a world of boxes, casts one scan in it, and compares the ranges with those that geometry
// says. With a file it also loads that world and casts the same scan there:
//   scan_a_room [WORLD.sdf]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <numbers>

#include <sim/backends/registry.h>
#include <sim/loaders/scene_file.h>
#include <sim/sensor/scanner.h>
#include <sim/world/anchor.h>

namespace {

using namespace scipd::sim;

constexpr double wall_m = 2.0;  ///< from the scanner to the face of each of the four walls
constexpr double height_m = 0.3;

/// Four walls around the origin, each 0.2 m thick.
SharedScene room() {
    auto scene = std::make_shared<Scene>();
    scene->models.push_back({.name = "room"});
    for (const double yaw : {0.0, 0.5, 1.0, 1.5}) {
        const Pose turned = pose_from_rpy({}, {0.0, 0.0, yaw * std::numbers::pi});
        const Pose shifted = pose_from_rpy({wall_m + 0.1, 0.0, 0.0}, {});
        scene->objects.push_back({.name = "room::wall",
                                  .model_from_object = turned * shifted,
                                  .shape = Box{{0.2, 2.0 * wall_m + 0.4, 2.0}}});
    }
    scene->anchor_m = anchor_of(*scene);
    return scene;
}

/// 270 degrees in steps of a quarter of a degree, without any error.
Scanner scanner() {
    const SensorSpec spec{.steps_per_turn = 1440,
                          .first_step = 0,
                          .last_step = 1080,
                          .front_step = 540,
                          .scan_period = std::chrono::milliseconds(25),
                          .max_range_m = 30.0};
    return {spec, {.accuracy = Accuracy::ideal}};
}

/// From the middle of a square room, a ray at this angle meets the wall that it points to most.
double true_range_m(double angle_rad) {
    return wall_m / std::max(std::abs(std::cos(angle_rad)), std::abs(std::sin(angle_rad)));
}

SharedScan scan_in(const SharedScene& scene, const char* backend) {
    const auto rays = make_backend(backend, scene);
    const Pose world_from_sensor = pose_from_rpy({0.0, 0.0, height_m}, {});
    return scanner().measure(*rays, 0, Time{}, {world_from_sensor});
}

double greatest_error_m(const Scan& scan) {
    const SensorSpec spec = scanner().spec();
    double error_m = 0.0;
    for (int beam = 0; beam < spec.beams(); ++beam) {
        const double range_m = scan.readings.at(static_cast<std::size_t>(beam)).range_m;
        const double should_be_m = true_range_m(spec.angle_rad(spec.first_step + beam));
        error_m = std::max(error_m, std::abs(range_m - should_be_m));
    }
    return error_m;
}

}  // namespace

int main(int argc, char** argv) try {
    constexpr double tolerable_m = 1e-5;
    for (const char* backend : {"embree", "reference"}) {
        const double error_m = greatest_error_m(*scan_in(room(), backend));
        std::printf("%s: the greatest error is %.2g m\n", backend, error_m);
        if (!(error_m < tolerable_m)) return 1;
    }
    if (argc < 2) return 0;
    const LoadedScene loaded = load_scene(argv[1]);
    const SharedScan scan = scan_in(loaded.scene, "embree");
    std::printf("%s: %zu objects, %.3f m straight ahead\n", argv[1], loaded.scene->objects.size(),
                scan->middle(540).range_m);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "scan_a_room: %s\n", error.what());
    return 1;
}
