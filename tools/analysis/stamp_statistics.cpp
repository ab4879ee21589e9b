// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/analysis/stamp_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tools/analysis/beam_statistics.h"

namespace scipd::tools {
namespace {

struct Point {
    double x;
    double y;
};

struct Line {
    double slope = 0;
    double slope_sd = 0;
    Point middle{};

    [[nodiscard]] double at(double x) const { return middle.y + slope * (x - middle.x); }
};

Line line_through(std::span<const Point> points) {
    Line line;
    const auto count = static_cast<double>(points.size());
    for (const Point& point : points) {
        line.middle.x += point.x / count;
        line.middle.y += point.y / count;
    }
    double xx = 0;
    double xy = 0;
    for (const Point& point : points) {
        xx += (point.x - line.middle.x) * (point.x - line.middle.x);
        xy += (point.x - line.middle.x) * (point.y - line.middle.y);
    }
    line.slope = xy / xx;
    double squares = 0;
    for (const Point& point : points)
        squares += std::pow(point.y - line.at(point.x), 2);
    line.slope_sd = std::sqrt(squares / (count - 2) / xx);
    return line;
}

/// From scan to scan, without the gaps where scans are missing.
std::vector<double> intervals_of(std::span<const double> times_s) {
    std::vector<double> intervals;
    for (std::size_t i = 1; i < times_s.size(); ++i)
        intervals.push_back(times_s[i] - times_s[i - 1]);
    const double usual = median_of(intervals);
    std::erase_if(intervals, [&](double interval) { return !(interval < 1.5 * usual); });
    return intervals;
}

void tell_rhythm(StampStatistics& statistics, std::span<const double> times_s) {
    const auto intervals = intervals_of(times_s);
    if (intervals.size() < 2) return;
    double sum = 0;
    for (const double interval : intervals)
        sum += interval;
    const double mean = sum / static_cast<double>(intervals.size());
    if (!(mean > 0)) return;
    double squares = 0;
    for (const double interval : intervals)
        squares += (interval - mean) * (interval - mean);
    statistics.rate_hz = 1 / mean;
    statistics.jitter_ms = 1e3 * std::sqrt(squares / static_cast<double>(intervals.size() - 1));
}

/// Whether the scans fall on ever other parts of a tick, so that rounding to it averages out: they
/// then are early and late by turns.
bool ticks_average_out(std::span<const Point> stamps, double tick_s) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < stamps.size(); ++i)
        steps.push_back(stamps[i].y - stamps[i - 1].y);
    const double usual_s = median_of(steps);
    if (!(usual_s > 0)) return false;
    std::vector<Point> counted{{0, stamps[0].y}};
    for (std::size_t i = 0; i < steps.size(); ++i)
        counted.push_back({counted.back().x + std::round(steps[i] / usual_s), stamps[i + 1].y});
    const Line line = line_through(counted);
    int turns = 0;
    double before = 0;
    for (const Point& point : counted) {
        const double late = point.y - line.at(point.x);
        if (late * before < 0) ++turns;
        if (std::abs(late) > 0.05 * tick_s) before = late;
    }
    return turns >= 12;
}

/// The scan of each twentieth of the time that came soonest after its stamp: waiting and rounding
/// only ever make it later.
std::vector<Point> soonest(std::span<const Point> stamps) {
    constexpr std::size_t parts = 20;
    std::vector<Point> points;
    for (std::size_t part = 0; part < parts; ++part) {
        const auto first = part * stamps.size() / parts;
        const auto end = (part + 1) * stamps.size() / parts;
        points.push_back(
            *std::ranges::min_element(stamps.subspan(first, end - first), {},
                                      [](const Point& point) { return point.x - point.y; }));
    }
    return points;
}

void tell_clock(StampStatistics& statistics, std::span<const Point> stamps, double tick_s) {
    constexpr std::size_t fewest = 40;
    const double seconds = stamps.empty() ? 0 : stamps.back().x - stamps.front().x;
    if (stamps.size() < fewest || !(seconds > 0)) return;
    const Line line = line_through(soonest(stamps));
    std::vector<double> delays;
    for (const Point& stamp : stamps)
        delays.push_back(line.at(stamp.x) - stamp.y);
    const double least = *std::ranges::min_element(delays);
    double sum = 0;
    for (const double delay : delays)
        sum += delay - least;
    statistics.delay_ms = 1e3 * sum / static_cast<double>(delays.size());
    const double by_ticks = ticks_average_out(stamps, tick_s) ? 0 : 1.5 * tick_s / seconds;
    statistics.clock = {1e6 * (line.slope - 1), 1e6 * std::hypot(4 * line.slope_sd, by_ticks)};
}

}  // namespace

StampStatistics stamp_statistics(std::span<const ScanTime> times, double tick_s) {
    std::vector<double> stamps_s;
    std::vector<double> host_s;
    std::vector<Point> both;
    for (const ScanTime& time : times) {
        if (time.stamp_s) stamps_s.push_back(*time.stamp_s);
        if (time.host_s) host_s.push_back(*time.host_s);
        if (time.stamp_s && time.host_s) both.push_back({*time.host_s, *time.stamp_s});
    }
    StampStatistics statistics;
    statistics.by_scanner = stamps_s.size() >= host_s.size() && !stamps_s.empty();
    tell_rhythm(statistics, statistics.by_scanner ? stamps_s : host_s);
    tell_clock(statistics, both, tick_s);
    return statistics;
}

}  // namespace scipd::tools
