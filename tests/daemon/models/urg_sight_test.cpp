// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the URG family sees of flat faces, against recordings of a URG-04LX before a white wall and
// before bright aluminium (srLarsons/FaultModeling-for-2D-Laser-scanner). Seeds are fixed.
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "daemon/models/model_registry.h"
#include "sim/sensor/echo_model.h"
#include "sim/sensor/scanner.h"

namespace scipd::daemon {
namespace {

constexpr double degree = 3.14159265358979 / 180.0;
constexpr int scans = 400;

/// One scan of a flat face at right angles to the front step, as wide as it is seen.
std::vector<sim::Reading> face_seen(const sim::SensorSpec& optics, double ahead_m,
                                    const sim::Surface& surface, std::int64_t revolution) {
    const sim::ErrorModel errors{.accuracy = sim::Accuracy::material, .seed = 3, .sensor = 9};
    const sim::BeamPattern pattern(optics);
    sim::Scan scan{.revolution = revolution, .world_from_sensor = {sim::Pose{}}};
    scan.rays_per_beam = pattern.rays_per_beam();
    for (const glm::vec3& direction : pattern.directions()) {
        sim::Hit& hit = scan.hits.emplace_back();
        if (direction.x > 0.05F)
            hit = {static_cast<float>(ahead_m) / direction.x, direction.x, 0, 0};
    }
    const sim::LitWorld lit(std::array{surface}, {});
    sim::find_echoes(scan, optics, pattern, lit, errors.key(revolution));
    errors.read(optics, sim::Conditions{}.on_for, scan);
    return scan.readings;
}

/// What five beams side by side read of the face in many scans.
struct Read {
    double seen = 0.0;  ///< the share that has a range
    double error_m = 0.0;
    double sigma_m = 0.0;  ///< of each beam over time
};

Read read_at(const sim::SensorSpec& optics, double bearing_deg, double ahead_m,
             const sim::Surface& surface) {
    constexpr int beams = 5;
    const auto first = std::lround(bearing_deg * degree / optics.beam_rad()) - beams / 2;
    std::array<double, beams> count{};
    std::array<double, beams> sum{};
    std::array<double, beams> squares{};
    for (int revolution = 0; revolution < scans; ++revolution) {
        const auto readings = face_seen(optics, ahead_m, surface, revolution);
        for (std::size_t i = 0; i < beams; ++i) {
            const int step = optics.front_step + static_cast<int>(first) + static_cast<int>(i);
            const auto& reading = readings[static_cast<std::size_t>(step - optics.first_step)];
            if (reading.cause != sim::Cause::measured) continue;
            const double range_m = ahead_m / std::cos(optics.angle_rad(step));
            const double error_m = double{reading.range_m} - range_m;
            ++count[i];
            sum[i] += error_m;
            squares[i] += error_m * error_m;
        }
    }
    Read read;
    double variance_m2 = 0.0;
    for (std::size_t i = 0; i < beams; ++i) {
        const double mean_m = sum[i] / count[i];
        read.seen += count[i] / scans / beams;
        read.error_m += mean_m / beams;
        variance_m2 += (squares[i] / count[i] - mean_m * mean_m) / beams;
    }
    read.sigma_m = std::sqrt(variance_m2);
    return read;
}

struct Recorded {
    double bearing_deg;
    double sigma_m;
};

TEST(UrgSight, ReadsAWhiteWallTo75Degrees) {
    // The wall is 1.02 m ahead, so 75 degrees are 3.9 m.
    constexpr Recorded wall[] = {
        {0, 0.0037}, {45, 0.0047}, {60, 0.0043}, {70, 0.0065}, {75, 0.0110}};
    for (const char* name : {"URG-04LX", "UBG-04LX-F01"}) {
        const sim::SensorSpec& optics = find_model(name).optics;
        for (const auto& [bearing_deg, sigma_m] : wall) {
            const Read read = read_at(optics, bearing_deg, 1.02, {.diffuse = 0.9F});
            EXPECT_NEAR(read.seen, 1.0, 1e-9) << name << ' ' << bearing_deg;
            const double error_m = read.sigma_m / std::sqrt(2.0 * scans);
            EXPECT_NEAR(read.sigma_m, sigma_m, 0.25 * sigma_m + error_m)
                << name << ' ' << bearing_deg;
        }
    }
}

// So much light comes back from 3.9 m at 75 degrees that the wall is seen head-on to the end of the
// range, and a dark target of 10 % to nearly 3 m.
TEST(UrgSight, SeesWhiteAndDarkAsFarAsThatWallSays) {
    const sim::SensorSpec& optics = find_model("URG-04LX").optics;
    EXPECT_NEAR(read_at(optics, 0, 5.5, {.diffuse = 0.9F}).seen, 1.0, 1e-9);
    EXPECT_NEAR(read_at(optics, 0, 2.8, {.diffuse = 0.1F}).seen, 1.0, 1e-9);
    EXPECT_LT(read_at(optics, 0, 4.0, {.diffuse = 0.1F}).seen, 0.01);
}

// Ranged, up to about 90 mm too far, and not refused as too bright.
TEST(UrgSight, ReadsBrightMetalTooFar) {
    const sim::SensorSpec& optics = find_model("URG-04LX").optics;
    const sim::Surface aluminium{.diffuse = 0.043F, .specular = 0.825F, .gloss = 2000.0F};
    for (const double ahead_m : {0.10, 0.22}) {
        const Read read = read_at(optics, 0, ahead_m, aluminium);
        EXPECT_NEAR(read.seen, 1.0, 1e-9) << ahead_m;
        EXPECT_GT(read.error_m, 0.030) << ahead_m;
        EXPECT_LT(read.error_m, 0.100) << ahead_m;
        // Aside of the highlight it is a dull face like others.
        EXPECT_NEAR(read_at(optics, 20, ahead_m, aluminium).error_m, 0.0, 0.03) << ahead_m;
    }
}

}  // namespace
}  // namespace scipd::daemon
