// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/tools/scipfit/synthetic_scanner.h"

#include <cmath>
#include <utility>

#include "daemon/device/bridge.h"
#include "sim/backends/embree.h"
#include "tests/support/scene_builder.h"

namespace scipd::tests {
namespace {

using sim::Box;
using sim::MaterialId;
using sim::Pose;

constexpr double wall_m = 0.1;

Pose at(double x_m, double y_m) {
    return sim::pose_from_rpy({x_m, y_m, 0.0}, {0.0, 0.0, 0.0});
}

sim::SharedLitWorld light_of(const Room& room) {
    std::vector<sim::Surface> surfaces;
    for (const double reflectance : room.reflectances)
        surfaces.push_back({.diffuse = static_cast<float>(reflectance)});
    while (surfaces.size() < 4 + room.things.size())
        surfaces.push_back(surfaces.back());
    return std::make_shared<const sim::LitWorld>(surfaces, std::vector<sim::Medium>{});
}

sim::ErrorModel errors_of(const daemon::Model& model, bool with_light, std::uint64_t seed) {
    return {.accuracy = with_light ? sim::Accuracy::material : sim::Accuracy::sensor,
            .seed = seed,
            .sensor = 1,
            .codes_vary = !model.profile.rare_codes.empty()};
}

}  // namespace

sim::SharedScene scene_of(const Room& room) {
    const double x = 0.5 * (room.length_m + wall_m);
    const double y = 0.5 * (room.width_m + wall_m);
    sim::SceneBuilder scene;
    scene.add(Box{{wall_m, room.width_m, 2.0}}, at(x, 0.0), 0);
    scene.add(Box{{room.length_m, wall_m, 2.0}}, at(0.0, y), 1);
    scene.add(Box{{wall_m, room.width_m, 2.0}}, at(-x, 0.0), 2);
    scene.add(Box{{room.length_m, wall_m, 2.0}}, at(0.0, -y), 3);
    MaterialId material = 4;
    for (const Room::Thing& thing : room.things)
        scene.add(Box{{2.0 * thing.half_m, 2.0 * thing.half_m, 2.0}}, at(thing.x_m, thing.y_m),
                  material++);
    return scene.build();
}

SyntheticScanner::SyntheticScanner(daemon::Model model, const Room& room, bool with_light,
                                   std::uint64_t seed)
    : model_(std::move(model)),
      with_light_(with_light),
      scanner_(model_.optics, errors_of(model_, with_light, seed)),
      lit_(light_of(room)),
      backend_(sim::make_embree_backend(scene_of(room))) {}

tools::ScanTable SyntheticScanner::begin() const {
    return {.files = "synthetic",
            .identity = {.model = model_.profile.model,
                         .firmware = model_.profile.firmware,
                         .min_range_m = 1e-3 * model_.profile.nearest_mm,
                         .max_range_m = 1e-3 * model_.profile.dmax_mm}};
}

/// Nothing moves, so it is cast once, and each scan reads the same hits with other chances.
void SyntheticScanner::stand(const Place& place, int scans, tools::ScanTable& readings) {
    const Pose pose = sim::pose_from_rpy({place.x_m, place.y_m, 0.0}, {0.0, 0.0, place.yaw_rad});
    const sim::Conditions conditions{.lit = with_light_ ? lit_.get() : nullptr};
    const sim::Scan cast = [&] {
        sim::Scan scan = scanner_.begin(0, {}, {pose});
        scanner_.cast(*backend_, scan, {0, scan.beams()}, conditions);
        return scan;
    }();
    for (int i = 0; i < scans; ++i) {
        sim::Scan scan = cast;
        scan.revolution = revolution_++;
        scanner_.read(scan, conditions);
        const auto wire = daemon::to_wire(scan, {}, model_.optics, model_.profile);
        sim::RecordedScan sent{
            .host_time = sim::HostTime(std::chrono::nanoseconds(scan.revolution * 25'000'000)),
            .stamp_us = static_cast<std::uint64_t>(scan.revolution) * 25'000,
            .directions = {.first_step = model_.optics.first_step,
                           .first_rad = model_.optics.angle_rad(model_.optics.first_step),
                           .increment_rad = model_.optics.beam_rad()},
            .ranges = {wire.distance.begin(), wire.distance.end()}};
        if (tells_intensities_)
            sent.intensities.assign(wire.intensity.begin(), wire.intensity.end());
        readings.add(sent);
    }
}

void end_recording(tools::ScanTable& readings) {
    readings.end_recording();
}

tools::ScanTable only(tools::ScanTable readings, std::size_t first, std::size_t last) {
    for (std::size_t i = 0; i < readings.ranges_mm.size(); ++i) {
        const std::size_t step = i % readings.beams;
        if (step >= first && step <= last) continue;
        readings.ranges_mm[i] = tools::no_number;
        if (!readings.intensities.empty()) readings.intensities[i] = tools::no_number;
        readings.codes[i] = 65533;
    }
    return readings;
}

}  // namespace scipd::tests
