// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/export.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <ostream>
#include <string>

#include "tools/formatted.h"
#include "tools/scipfit/smoothing_fit.h"

namespace scipd::tools {
namespace {

constexpr double near_m = 0.5;
constexpr double far_m = 8.0;

/// One number for all ranges of a room: the root of the mean variance.
double one_sigma_m(const sim::SensorSpec& optics) {
    constexpr int steps = 16;
    const double to_m = std::min(far_m, optics.max_range_m);
    double variance = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double range_m = near_m + (to_m - near_m) * (i + 0.5) / steps;
        variance += std::pow(optics.sigma_m(range_m), 2) / steps;
    }
    return std::sqrt(variance);
}

double degrees(const sim::SensorSpec& optics) {
    return (optics.beams() - 1) * optics.beam_rad() * 180.0 / std::numbers::pi;
}

double period_s(const sim::SensorSpec& optics) {
    return std::chrono::duration<double>(optics.scan_period).count();
}

/// So many times the variance of independent beams has the mean of five neighbours.
double variance_of_five(const sim::SensorSpec& optics) {
    const auto shared = correlations_of(optics.smoothing);
    double times = 1.0;
    for (std::size_t lag = 0; lag < shared.size(); ++lag)
        times += 2.0 * static_cast<double>(4 - lag) / 5.0 * shared[lag];
    return times;
}

std::string sigma_text(const sim::SensorSpec& optics) {
    return formatted("%.1f mm at %.1f m, %.1f mm at %.0f m; here one number for all",
                     1000.0 * optics.sigma_m(near_m), near_m,
                     1000.0 * optics.sigma_m(std::min(far_m, optics.max_range_m)),
                     std::min(far_m, optics.max_range_m));
}

std::string sharing_text(const sim::SensorSpec& optics) {
    return formatted("neighbours share their noise: the mean of five has %.2f times the variance",
                     variance_of_five(optics));
}

}  // namespace

void write_amcl(const sim::SensorSpec& optics, std::ostream& out) {
    const double lost = std::clamp(optics.lost_share, 0.001, 0.5);
    constexpr double random = 0.01;
    constexpr double short_of_it = 0.01;
    out << "# AMCL. It cannot hold:\n"
        << "# - the law of the noise (" << sigma_text(optics) << ")\n"
        << "# - that " << sharing_text(optics) << "; few beams (laser_max_beams) help\n"
        << "# - codes, and the bias of the unit\n"
        << "# laser_sigma_hit is that of the scanner alone: a map of 50 mm cells adds 15 mm.\n"
        << "laser_model_type: likelihood_field\n"
        << formatted("laser_z_hit: %.4f\n", 1.0 - lost - random - short_of_it)
        << formatted(
               "laser_z_max: %.4f   # of the profile: beams without a distance, 0.001 at "
               "least\n",
               lost)
        << formatted("laser_z_rand: %.4f  # assumed: mixed pixels\n", random)
        << formatted("laser_z_short: %.4f # assumed: people who pass\n", short_of_it)
        << formatted("laser_sigma_hit: %.5f\n", one_sigma_m(optics))
        << formatted("laser_max_range: %g\n", optics.max_range_m);
}

void write_gz(const sim::SensorSpec& optics, std::ostream& out) {
    out << "<!-- Gazebo: of a <lidar> or <ray>. It cannot hold:\n"
        << "     the law of the noise (" << sigma_text(optics) << "),\n"
        << "     that " << sharing_text(optics) << ",\n"
        << "     codes, lost beams, intensities, and the bias as a curve. -->\n"
        << "<noise>\n  <type>gaussian</type>\n"
        << formatted("  <mean>%.5f</mean>\n", optics.bias.empty() ? 0.0 : optics.bias_m(2.0))
        << formatted("  <stddev>%.5f</stddev>\n", one_sigma_m(optics)) << "</noise>\n";
}

void write_mvsim(const sim::SensorSpec& optics, std::ostream& out) {
    out << "<!-- MVSim. It cannot hold:\n"
        << "     the law of the noise (" << sigma_text(optics) << "),\n"
        << "     that " << sharing_text(optics) << ",\n"
        << "     codes, lost beams, intensities, bias. -->\n"
        << "<sensor class=\"laser\" name=\"laser\">\n"
        << formatted("  <fov_degrees>%.3f</fov_degrees>\n", degrees(optics))
        << formatted("  <nrays>%d</nrays>\n", optics.beams())
        << formatted("  <max_range>%g</max_range>\n", optics.max_range_m)
        << formatted("  <sensor_period>%g</sensor_period>\n", period_s(optics))
        << formatted("  <range_std_noise>%.5f</range_std_noise>\n", one_sigma_m(optics))
        << "  <angle_std_noise_deg>0</angle_std_noise_deg>\n</sensor>\n";
}

void write_stage(const sim::SensorSpec& optics, std::ostream& out) {
    out << "# Stage. It cannot hold:\n"
        << "# - the law of the noise (" << sigma_text(optics) << ")\n"
        << "# - that " << sharing_text(optics) << "\n"
        << "# - codes, lost beams, intensities, bias\n"
        << "define fitted ranger\n(\n  sensor\n  (\n"
        << formatted("    range [ 0.0 %g ]\n", optics.max_range_m)
        << formatted("    fov %.3f\n", degrees(optics))
        << formatted("    samples %d\n", optics.beams())
        << formatted("    noise [ %.5f 0 0 ]  # of a range, of its share, of the angle\n",
                     one_sigma_m(optics))
        << "  )\n)\n";
}

}  // namespace scipd::tools
