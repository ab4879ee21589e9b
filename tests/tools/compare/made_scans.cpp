// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/tools/compare/made_scans.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <random>
#include <vector>

namespace scipd::tests {
namespace {

constexpr double first_rad = -2.356194490192345;
constexpr double increment_rad = 0.004363323129985824;

struct Segment {
    double x0, y0, x1, y1;
    bool window = false;
};

std::vector<Segment> room_of(const MadeScans& made) {
    const double face_m = 1.5 - made.box_nearer_m;
    return {
        {-3, -2, 3, -2}, {3, -2, 3, 0.2}, {3, 0.2, 3, 0.8, true},       {3, 0.8, 3, 2},
        {3, 2, -3, 2},   {-3, 2, -3, -2}, {face_m, -1.2, face_m, -0.6}, {face_m, -0.6, 2.2, -0.6}};
}

/// Along the ray; 0 if it misses.
double range_to(const Segment& wall, double x, double y, double angle_rad) {
    const double across = std::cos(angle_rad);
    const double up = std::sin(angle_rad);
    const double along_x = wall.x1 - wall.x0;
    const double along_y = wall.y1 - wall.y0;
    const double cross = across * along_y - up * along_x;
    if (std::abs(cross) < 1e-12) return 0;
    const double range = ((wall.x0 - x) * along_y - (wall.y0 - y) * along_x) / cross;
    const double place = ((wall.x0 - x) * up - (wall.y0 - y) * across) / cross;
    return range > 1e-6 && place >= 0 && place <= 1 ? range : 0;
}

/// Reads the room once, each step with its own noise.
class Reader {
  public:
    explicit Reader(const MadeScans& made) : made_(made), chance_(made.seed) {
        for (int step = 0; step < made.steps; ++step)
            ranges_m_.push_back(made_range_m(made, first_rad + step * increment_rad));
    }

    [[nodiscard]] sim::RecordedScan next() {
        sim::RecordedScan scan;
        const auto noise = draw_noise();
        for (int step = 0; step < made_.steps; ++step) {
            const double value = reading(step, noise[step]);
            const bool far = value >= 20;
            scan.ranges.push_back(value);
            const double light = far ? 1200 * made_.bright * (1 + 0.012 * normal_(chance_)) : 0;
            scan.intensities.push_back(std::round(light));
        }
        scan.directions.first_step = 0;
        if (made_.angles) {
            scan.directions.first_rad = first_rad;
            scan.directions.increment_rad = increment_rad;
        }
        tell_time(scan);
        ++count_;
        return scan;
    }

  private:
    std::vector<double> draw_noise() {
        std::vector<double> white(made_.steps + 2);
        for (double& value : white)
            value = normal_(chance_);
        std::vector<double> noise(made_.steps);
        const double all = std::sqrt(1 + 2 * made_.shared * made_.shared);
        for (int step = 0; step < made_.steps; ++step)
            noise[step] = made_.sigma_mm / all *
                          (white[step + 1] + made_.shared * (white[step] + white[step + 2]));
        return noise;
    }

    double reading(int step, double noise_mm) {
        const auto range_m = ranges_m_[step];
        const double next_m = ranges_m_[std::min(step + 1, made_.steps - 1)];
        if (range_m == 0) return made_.window_code;
        const bool beside = next_m == 0 || ranges_m_[std::max(step - 1, 0)] == 0;
        if (beside && even_(chance_) < 0.33) return made_.edge_code;
        double seen_m = range_m;
        // At an edge the beam is on one surface, on the other, or on both.
        if (next_m > 0 && std::abs(next_m - range_m) > 0.2) {
            const double share = even_(chance_);
            seen_m += (next_m - range_m) * (share < 0.3 ? 1 : share < 0.5 ? even_(chance_) : 0);
        }
        return std::round(1e3 * seen_m + made_.too_far_mm * std::sqrt(seen_m / 2) + noise_mm);
    }

    void tell_time(sim::RecordedScan& scan) {
        const double device_s = 12.3456 + count_ * made_.period_s * (1 + 1e-6 * made_.ppm);
        scan.stamp_ms = static_cast<std::uint32_t>(std::floor(1e3 * device_s));
        const double late_s = 1e-3 * (20 - made_.jitter_ms * std::log(1 - even_(chance_)));
        scan.host_time =
            sim::host_time_at(1'700'000'000) +
            std::chrono::nanoseconds(std::llround(1e9 * (count_ * made_.period_s + late_s)));
    }

    MadeScans made_;
    std::mt19937 chance_;
    std::normal_distribution<double> normal_;
    std::uniform_real_distribution<double> even_;
    std::vector<double> ranges_m_;
    int count_ = 0;
};

}  // namespace

double made_range_m(const MadeScans& made, double angle_rad) {
    double nearest_m = 1e9;
    bool window = false;
    for (const Segment& wall : room_of(made)) {
        const double range_m = range_to(wall, made.x_m, made.y_m, angle_rad + made.yaw_rad);
        if (range_m == 0 || range_m >= nearest_m) continue;
        nearest_m = range_m;
        window = wall.window;
    }
    return window ? 0 : nearest_m;
}

tools::comparing::Taken make_scans(const MadeScans& made) {
    sim::ScannerIdentity identity;
    identity.model = "MADE";
    identity.min_range_m = 0.02;
    identity.max_range_m = 30;
    tools::ScanTable series{.identity = identity};
    Reader reader(made);
    for (int i = 0; i < made.scans; ++i)
        series.add(reader.next());
    return {"made", std::move(series), {}, {}};
}

}  // namespace scipd::tests
