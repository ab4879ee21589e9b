// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/models/product_lines.h"

#include <chrono>
#include <utility>
#include <vector>

namespace scipd::daemon {

namespace {

/// Seven rays for each beam, with these halves of the footprint.
sim::Footprint spot(double half_width_rad, double half_height_rad) {
    return {.half_width_rad = half_width_rad, .half_height_rad = half_height_rad, .rays = 7};
}

/// Medians of a recorded scan of a UTM-30LX, whose values went from 137 to 16219: it shows near and
/// far faces almost alike. That the faces of that room were white and matt is assumed, as are the
/// points behind 6.5 m.
std::vector<sim::IntensityPoint> utm_intensity() {
    return {{0.25, 1366}, {0.75, 2892}, {1.5, 2561},  {2.5, 2704},
            {4.0, 2316},  {6.5, 1853},  {12.0, 1350}, {30.0, 850}};
}

/// The brightest matt walls of a recorded UST (SkoltechRobotics/Eurobot2018); that they are white
/// is assumed, as are the points behind 6.5 m.
std::vector<sim::IntensityPoint> ust_intensity() {
    return {{0.3, 600}, {0.75, 1400}, {1.5, 1100}, {2.5, 1080},
            {3.5, 950}, {6.5, 800},   {12.0, 500}, {30.0, 300}};
}

/// Those that show none tell their light by its noise: a URG-04LX before a white wall has 4.7 mm at
/// 45 degrees and 11 mm at 75 (srLarsons/FaultModeling-for-2D-Laser-scanner), which is that of
/// light that falls with the square of the range. How large the numbers are is assumed.
std::vector<sim::IntensityPoint> square_law_intensity() {
    return {{0.5, 10240}, {0.75, 4551}, {1.0, 2560}, {1.5, 1138}, {2.0, 640}, {2.5, 410},
            {3.0, 284},   {4.0, 160},   {5.0, 102},  {6.0, 71},   {8.0, 40}};
}

/// A recorded UST (as above): 3.5 % below 350, 0.8 % at 850, 3 % and more at retro-reflectors.
std::vector<sim::IntensityNoisePoint> intensity_noise() {
    return {{275, 0.035}, {425, 0.018}, {600, 0.014}, {850, 0.009}, {1250, 0.012}, {3000, 0.03}};
}

/// Retro-reflective beacons of a recorded UST (as above) have 10000, 7860 and 5820 at 0.61, 1.43
/// and 2.77 m, where white faces have some 1000: the film is 220 times as bright, and 1.1 more for
/// each e-fold fits them within a quarter.
constexpr double ust_log_gain = 1.1;
/// The brightest step of the UTM-30LX's scan, 16219 at 0.82 m, is taken for a highlight.
constexpr double utm_log_gain = 0.7;
/// Assumed. From a wider lens a UTM-30LX would show a pane at 0.7 m wider than the 5 steps within
/// which a published detector finds real ones (uts-magic-lab/slam_glass).
constexpr double aperture_m = 0.005;

sim::Receiver pulse_receiver(double dark_range_m, std::vector<sim::IntensityPoint> intensity,
                             double log_gain) {
    return {.wavelength_nm = 905,
            .dark_range_m = dark_range_m,
            .half_pulse_m = 0.75,
            .walk_m = 0.01,
            .aperture_m = aperture_m,
            .intensity = std::move(intensity),
            .log_gain = log_gain,
            .most_intensity = 16383,
            .intensity_noise = intensity_noise()};
}

constexpr sim::Smoothing median_of_five{.median_of_five = true};

/// Assumed. Recordings of 10 to 126 s drift by 0.6 to 4 mm (docs/errors.md).
sim::WarmUp warm_up(double drift_m, std::chrono::minutes time_constant) {
    return {.drift_m = drift_m, .time_constant = time_constant};
}

}  // namespace

protocol::DistanceCodes urg_codes() {
    return {.nothing = 0,
            .too_near = 10,
            .too_far = 0,
            .not_measured = 19,
            .too_bright = 18,
            .edge = 7,
            .interference = 9,
            .lost = 9};
}

std::vector<protocol::RareCode> urg_rare_codes() {
    return {{.code = 7, .inside = 0.0178, .beside = 0.137, .alone = true},
            {.code = 6, .inside = 0.0150, .beside = 0.0126, .edge = 0.046},
            {.code = 1, .inside = 0.0047, .beside = 0.0042},
            {.code = 10, .inside = 0.0008, .beside = 0.0101, .edge = 0.064},
            {.code = 2, .inside = 0.0014, .beside = 0.0018},
            {.code = 8, .inside = 0.0007, .beside = 0.0044, .edge = 0.022},
            {.code = 15, .inside = 0.0004, .beside = 0.0036, .edge = 0.017}};
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
    return {.noise_law = {.floor_m = 0.00278, .weak = 60.0},
            .smoothing = median_of_five,
            .accuracy = {{.from_range_m = 0.0, .bound_m = 0.010, .bound_share = 0.0},
                         {.from_range_m = 1.0, .bound_m = 0.0, .bound_share = 0.01}},
            .warm_up = warm_up(0.004, 4min),
            .footprint = spot(0.005, 0.005),
            .receiver = {.wavelength_nm = 785,
                         .dark_range_m = 3.2,
                         .half_pulse_m = 1.5,
                         .walk_m = 0.01,
                         .saturating_signal = 10.0,
                         .saturation_m = 0.04,
                         .edge_share = 0.3,
                         .aperture_m = aperture_m,
                         .intensity = square_law_intensity(),
                         .log_gain = utm_log_gain,
                         .most_intensity = 16383,
                         .intensity_noise = intensity_noise()}};
}

sim::SensorSpec uhg_optics() {
    sim::SensorSpec optics = urg_optics();
    optics.noise_law = {.floor_m = 0.0037, .weak = 45.0};
    optics.accuracy = {{.from_range_m = 0.0, .bound_m = 0.030, .bound_share = 0.0},
                       {.from_range_m = 1.0, .bound_m = 0.0, .bound_share = 0.03}};
    return optics;
}

sim::SensorSpec utm_optics() {
    using namespace std::chrono_literals;
    return {.noise_law = {.floor_m = 0.0036, .weak = 900.0},
            .smoothing = median_of_five,
            .accuracy = {{.from_range_m = 0.0, .bound_m = 0.030, .bound_share = 0.0},
                         {.from_range_m = 10.0, .bound_m = 0.050, .bound_share = 0.0}},
            .warm_up = warm_up(0.003, 4min),
            .footprint = spot(0.0066, 0.0066),
            .receiver = pulse_receiver(12.0, utm_intensity(), utm_log_gain)};
}

sim::SensorSpec ust_optics(double dark_range_m) {
    using namespace std::chrono_literals;
    return {.noise_law = {.floor_m = 0.0046, .weak = 870.0},
            .smoothing = {.next = 0.2, .after_next = 0.05},
            .accuracy = {{.from_range_m = 0.0, .bound_m = 0.040, .bound_share = 0.0}},
            .warm_up = warm_up(0.003, 4min),
            .lattice_m = 0.0015,
            .footprint = spot(0.0066, 0.0066),
            .receiver = pulse_receiver(dark_range_m, ust_intensity(), ust_log_gain)};
}

sim::SensorSpec uxm_optics() {
    sim::SensorSpec optics = utm_optics();
    optics.noise_law.floor_m = 0.0045;
    return optics;
}

void take_uxm_limits(protocol::DeviceProfile& profile) {
    profile.dmin_mm = 100;
    profile.nearest_mm = 100;
    profile.dmax_mm = 100000;
    profile.amax = 760;
    profile.last_step = 760;
    profile.afrt = 380;
    profile.scan_rpm = 1200;
}

void double_resolution(protocol::DeviceProfile& profile) {
    for (int* steps :
         {&profile.ares, &profile.amin, &profile.amax, &profile.afrt, &profile.last_step})
        *steps *= 2;
}

}  // namespace scipd::daemon
