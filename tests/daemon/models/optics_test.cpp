// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the models see of panes and of thin things, as those see it who look for them.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "daemon/models/model_registry.h"
#include "sim/backends/registry.h"
#include "sim/loaders/materials/materials_file.h"
#include "sim/sensor/scanner.h"
#include "tests/support/scene_builder.h"

namespace scipd::daemon {
namespace {

sim::Surface stock(const char* name) {
    sim::MaterialLibrary library;
    for (sim::MaterialOptics& material :
         sim::load_materials(std::filesystem::path{SCIPD_SCENES} / "materials.yaml"))
        library.add(std::move(material));
    return library.surface({name}, 905);
}

sim::Pose ahead(double x_m, double y_m = 0.0) {
    return sim::pose_from_rpy({x_m, y_m, 0.0}, {0.0, 0.0, 0.0});
}

/// Scans of a model that stands at the origin and looks along x, but for a turn that lies between
/// two steps and is another in each scan.
std::vector<sim::SharedScan> scans(const sim::SensorSpec& optics, const sim::SharedScene& scene,
                                   const std::vector<sim::Surface>& surfaces,
                                   sim::EchoChoice choice, int count = 60) {
    sim::ErrorModel errors{.accuracy = sim::Accuracy::material, .seed = 5, .sensor = 2};
    errors.choice = choice;
    errors.tells_every_echo = true;
    const sim::Scanner scanner(optics, errors);
    const sim::LitWorld lit(surfaces, {});
    const auto backend = sim::find_backend("embree")->make(scene, {});
    std::vector<sim::SharedScan> all;
    for (int i = 0; i < count; ++i) {
        const double turned_rad = optics.beam_rad() * i / count;
        all.push_back(scanner.measure(
            *backend, i, {}, {sim::pose_from_rpy({}, {0.0, 0.0, turned_rad})}, {.lit = &lit}));
    }
    return all;
}

/// What slam_glass (uts-magic-lab) takes for a pane: a step brighter than 8000, 4000 brighter than
/// the one before it, and 4000 darker again within 5 steps at the same range.
bool shows_a_pane(const std::vector<sim::Reading>& readings) {
    for (std::size_t k = 1; k + 5 < readings.size(); ++k) {
        const float bright = readings[k].intensity;
        if (bright <= 8000.0F || bright - readings[k - 1].intensity < 4000.0F) continue;
        for (std::size_t i = k + 1; i <= k + 5; ++i) {
            if (readings[i].cause == sim::Cause::measured &&
                bright - readings[i].intensity >= 4000.0F &&
                std::abs(readings[i].range_m - readings[k].range_m) < 0.1F)
                return true;
        }
    }
    return false;
}

TEST(Pane, IsFoundByAPublishedDetectorAndAWhiteWallIsNot) {
    const sim::SensorSpec optics = find_model("UTM-30LX-EW").optics;
    const std::vector<sim::Surface> surfaces{stock("default"), stock("glass")};
    for (const double range_m : {0.7, 1.5, 3.0}) {
        for (const bool behind : {false, true}) {
            sim::SceneBuilder builder;
            builder.add(sim::Box{{0.006, 3.0, 3.0}}, ahead(range_m + 0.003), 1);
            if (behind) builder.add(sim::Box{{0.2, 9.0, 9.0}}, ahead(range_m + 2.1), 0);
            int found = 0;
            for (const auto& scan :
                 scans(optics, builder.build(), surfaces, sim::EchoChoice::strongest))
                found += shows_a_pane(scan->readings) ? 1 : 0;
            EXPECT_GE(found, 48) << range_m << " m, wall behind: " << behind;
        }
        const auto wall =
            sim::SceneBuilder().add(sim::Box{{0.2, 9.0, 9.0}}, ahead(range_m + 0.1), 0).build();
        for (const auto& scan : scans(optics, wall, surfaces, sim::EchoChoice::strongest))
            EXPECT_FALSE(shows_a_pane(scan->readings)) << range_m;
    }
}

/// The share of the beams ahead that have an echo within 0.1 m of upright wires of 3 mm, which
/// stand 50 mm apart and 2 m away.
double share_at_wires(const char* model, int rays, sim::EchoChoice choice) {
    constexpr double away_m = 2.0;
    sim::SceneBuilder builder;
    for (int i = -40; i <= 40; ++i)
        builder.add(sim::Cylinder{0.0015, 3.0}, ahead(away_m, 0.05 * i), 0);
    sim::SensorSpec optics = find_model(model).optics;
    optics.footprint.rays = rays;
    double beams = 0.0;
    double met = 0.0;
    for (const auto& scan : scans(optics, builder.build(), {stock("default")}, choice, 10)) {
        for (std::size_t beam = 0; beam < scan->beams(); ++beam) {
            const double azimuth_rad =
                optics.angle_rad(optics.first_step + static_cast<double>(beam));
            if (std::abs(azimuth_rad) > std::numbers::pi / 8) continue;
            ++beams;
            const auto there = [&](const sim::Reading& reading) {
                return reading.cause == sim::Cause::measured &&
                       std::abs(reading.range_m - away_m / std::cos(azimuth_rad)) < 0.1;
            };
            const bool met_here = choice == sim::EchoChoice::first
                                      ? there(scan->readings[beam])
                                      : std::ranges::any_of(scan->every_echo[beam], there);
            met += met_here ? 1.0 : 0.0;
        }
    }
    return met / beams;
}

TEST(ThinThings, AreSeenByMoreThanHalfOfTheBeamsThatTouchThem) {
    EXPECT_GE(share_at_wires("UTM-30LX-EW", 13, sim::EchoChoice::strongest), 0.5);
    EXPECT_GE(share_at_wires("UST-10LX", 13, sim::EchoChoice::first), 0.5);
    EXPECT_GE(share_at_wires("UTM-30LX-EW", 7, sim::EchoChoice::strongest), 0.36);
    EXPECT_GE(share_at_wires("UST-10LX", 7, sim::EchoChoice::first), 0.36);
}

}  // namespace
}  // namespace scipd::daemon
