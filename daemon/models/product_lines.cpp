// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/models/product_lines.h"

#include <chrono>

namespace scipd::daemon {

namespace {

/// Seven rays for each beam, with these halves of the footprint.
sim::Footprint spot(double half_width_rad, double half_height_rad) {
    return {.half_width_rad = half_width_rad, .half_height_rad = half_height_rad, .rays = 7};
}

/// Medians of a recorded scan of a UTM-30LX, whose values went from 137 to 16219: it shows near and
/// far faces almost alike. That the faces of that room were white and matt is assumed, as are the
/// points behind 6.5 m.
std::vector<sim::IntensityPoint> recorded_intensity() {
    return {{0.25, 1366}, {0.75, 2892}, {1.5, 2561},  {2.5, 2704},
            {4.0, 2316},  {6.5, 1853},  {12.0, 1350}, {30.0, 850}};
}

sim::Receiver pulse_receiver(double dark_range_m) {
    return {.wavelength_nm = 905,
            .dark_range_m = dark_range_m,
            .half_pulse_m = 0.75,
            .walk_m = 0.01,
            .intensity = recorded_intensity(),
            .most_intensity = 16383};
}

sim::WarmUp warm_up(double drift_m, std::chrono::minutes time_constant) {
    return {.drift_m = drift_m, .time_constant = time_constant};
}

}  // namespace

protocol::DistanceCodes urg_codes() {
    return {.nothing = 0,
            .too_near = 10,
            .too_far = 0,
            .not_measured = 19,
            .too_dark = 1,
            .too_bright = 18,
            .edge = 8,
            .interference = 9,
            .lost = 9};
}

protocol::DistanceCodes utm_codes() {
    return {.nothing = 1,
            .too_near = 2,
            .too_far = 1,
            .not_measured = 5,
            .too_bright = 5,
            .edge = 5,
            .interference = 3,
            .lost = 5};
}

sim::SensorSpec urg_optics() {
    using namespace std::chrono_literals;
    return {
        .noise = {{.from_range_m = 0.0, .sigma_m = 0.010, .sigma_share = 0.0},
                  {.from_range_m = 1.0, .sigma_m = 0.0, .sigma_share = 0.01}},
        .bias =
            {{0.06, 0.003}, {0.5, 0.0}, {1.0, -0.003}, {2.0, -0.005}, {3.0, 0.005}, {4.0, 0.010}},
        .warm_up = warm_up(0.010, 20min),
        .footprint = spot(0.005, 0.005),
        .receiver = {.wavelength_nm = 785,
                     .dark_range_m = 1.6,
                     .half_pulse_m = 1.5,
                     .walk_m = 0.01,
                     .blinding_signal = 200.0,
                     .edge_share = 0.3,
                     .intensity = recorded_intensity(),
                     .most_intensity = 16383}};
}

sim::SensorSpec utm_optics() {
    using namespace std::chrono_literals;
    return {.noise = {{.from_range_m = 0.0, .sigma_m = 0.010, .sigma_share = 0.0},
                      {.from_range_m = 10.0, .sigma_m = 0.030, .sigma_share = 0.0}},
            .bias = {{2.0, 0.0114},
                     {3.0, 0.0165},
                     {4.5, 0.00405},
                     {6.0, 0.0072},
                     {9.0, 0.0225},
                     {10.5, 0.00735},
                     {12.0, 0.0048},
                     {15.0, 0.0075},
                     {21.0, 0.0021},
                     {23.0, 0.0161},
                     {25.0, 0.0075},
                     {29.0, 0.0174},
                     {30.0, 0.0009}},
            .warm_up = warm_up(0.005, 20min),
            .footprint = spot(0.0066, 0.0066),
            .receiver = pulse_receiver(12.0)};
}

sim::SensorSpec ust_optics(double dark_range_m) {
    using namespace std::chrono_literals;
    return {.noise = {{.from_range_m = 0.0, .sigma_m = 0.030, .sigma_share = 0.0}},
            .warm_up = warm_up(0.005, 15min),
            .footprint = spot(0.0066, 0.0066),
            .receiver = pulse_receiver(dark_range_m)};
}

sim::SensorSpec uxm_optics() {
    return ust_optics(12.0);
}

void double_resolution(protocol::DeviceProfile& profile) {
    for (int* steps :
         {&profile.ares, &profile.amin, &profile.amax, &profile.afrt, &profile.last_step})
        *steps *= 2;
}

}  // namespace scipd::daemon
