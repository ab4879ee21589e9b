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

double took_s(const ClockAnswer& answer) {
    return answer.answered_s - answer.asked_s;
}

double middle_s(const ClockAnswer& answer) {
    return (answer.asked_s + answer.answered_s) / 2;
}

/// An answer that took longer than usual tells less.
std::vector<ClockAnswer> without_late_ones(std::span<const ClockAnswer> answers) {
    std::vector<double> times_s;
    for (const ClockAnswer& answer : answers)
        times_s.push_back(took_s(answer));
    const double usual_s = median_of(times_s);
    std::vector<ClockAnswer> kept(answers.begin(), answers.end());
    std::erase_if(kept, [&](const ClockAnswer& answer) { return took_s(answer) > 1.5 * usual_s; });
    return kept;
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

std::optional<ClockReading> clock_reading(std::span<const ClockAnswer> answers) {
    constexpr std::size_t fewest = 4;
    if (answers.size() < fewest) return std::nullopt;
    const auto kept = without_late_ones(answers);
    if (kept.size() < fewest) return std::nullopt;
    const auto count = static_cast<double>(kept.size());
    ClockReading reading{.soonest_s = took_s(*std::ranges::min_element(kept, {}, took_s))};
    for (const ClockAnswer& answer : kept) {
        reading.device_s += answer.device_s / count;
        reading.host_s += middle_s(answer) / count;
        reading.took_s += took_s(answer) / count;
    }
    double squares = 0;
    for (const ClockAnswer& answer : kept)
        squares +=
            std::pow(answer.device_s - reading.device_s - middle_s(answer) + reading.host_s, 2);
    reading.deviation_s = std::sqrt(squares / (count - 1) / count);
    // The clock had ticked half a millisecond ago.
    reading.device_s += 0.5e-3;
    return reading;
}

ClockRate rate_between(const ClockReading& before, const ClockReading& after) {
    constexpr double wrap_s = (1U << 24) / 1e3;
    // Scanners answer on a grid of their own, which the scatter of the answers does not show.
    constexpr double unseen_s = 5e-5;
    const double host_s = after.host_s - before.host_s;
    double device_s = after.device_s - before.device_s;
    device_s += wrap_s * std::round((host_s - device_s) / wrap_s);
    const double by_chance_s = std::hypot(4 * before.deviation_s, 4 * after.deviation_s, unseen_s);
    const double soonest_s = std::min(before.soonest_s, after.soonest_s);
    const double by_waiting_s = (before.took_s - soonest_s + after.took_s - soonest_s) / 2;
    return {1e6 * (device_s / host_s - 1), 1e6 * (by_chance_s + by_waiting_s) / host_s};
}

}  // namespace scipd::tools
