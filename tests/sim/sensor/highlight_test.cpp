// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The highlight of a mirror against a beam whose light is followed to the lens and back.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/sim/sensor/lit_scan.h"

namespace scipd::sim {
namespace {

constexpr double half_width_rad = 0.006;
constexpr double aperture_m = 0.006;
constexpr float reflectance = 0.5F;
constexpr int steps_per_turn = 14'400;
constexpr int half = 60;  ///< steps to each side

SensorSpec fine_scanner(int rays) {
    SensorSpec spec = small_scanner(half_width_rad, rays);
    spec.steps_per_turn = steps_per_turn;
    spec.last_step = 2 * half;
    spec.front_step = half;
    spec.receiver.aperture_m = aperture_m;
    return spec;
}

/// Light that leaves at an angle to the mirror's normal comes back displaced by twice the way times
/// that angle. All of it that falls into the lens is compared with what the lens gets of a white
/// matt face at the same range.
double light_in_lens(double range_m, double beam_rad) {
    constexpr int cells = 100;
    const double lens_rad = aperture_m / (2.0 * range_m);
    const double cell_rad = 2.0 * lens_rad / cells;
    double sum = 0.0;
    for (int i = 0; i < cells; ++i) {
        for (int j = 0; j < cells; ++j) {
            const double across_rad = (i + 0.5) * cell_rad - lens_rad;
            const double up_rad = (j + 0.5) * cell_rad - lens_rad;
            if (std::hypot(across_rad, up_rad) > lens_rad) continue;
            const double off = std::hypot(across_rad - beam_rad, up_rad) / half_width_rad;
            sum += std::exp(-2.0 * off * off) * cell_rad * cell_rad;
        }
    }
    const double share = sum * 2.0 / (std::numbers::pi * half_width_rad * half_width_rad);
    const double of_white = std::pow(aperture_m / range_m, 2);
    return reflectance * share / of_white;
}

class Highlight : public testing::TestWithParam<const char*> {};

// A Gaussian stands for the round lens, which makes a seventh where beam and lens are as wide.
TEST_P(Highlight, HasTheHeightAndTheWidthOfTheBeamAndTheLens) {
    const std::vector<Surface> surfaces{white,
                                        {.diffuse = 0.0F, .specular = reflectance, .gloss = 1e6F}};
    double before = 0.0;
    for (const double range_m : {0.5, 1.0, 2.0, 5.0}) {
        const auto scene =
            SceneBuilder().add(Box{{0.1, 9.0, 9.0}}, ahead(range_m + 0.05), 1).build();
        for (const int rays : {1, 7, 13}) {
            const auto seen = lit_scan(GetParam(), scene, surfaces, fine_scanner(rays));
            const double top = light_in_lens(range_m, 0.0);
            for (int step = -half; step <= half; ++step) {
                const double beam_rad = 2.0 * std::numbers::pi * step / steps_per_turn;
                const auto echoes = seen->echoes[static_cast<std::size_t>(half + step)];
                const double power = echoes.empty() ? 0.0 : double{echoes.front().power};
                EXPECT_NEAR(power, light_in_lens(range_m, beam_rad), 0.15 * top)
                    << range_m << " m, " << step << ", " << rays;
            }
            EXPECT_NEAR(seen->echoes[half].front().power, top, 0.15 * top) << range_m;
        }
        // Beside a white face it is the brighter the farther, as long as the lens takes all of it.
        const double top = light_in_lens(range_m, 0.0);
        EXPECT_GT(top, before);
        before = top;
    }
}

INSTANTIATE_TEST_SUITE_P(Through, Highlight, testing::Values("embree", "reference"),
                         [](const auto& backend) { return std::string(backend.param); });

}  // namespace
}  // namespace scipd::sim
