// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/proxy/twin_comparison.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace scipd::tools {
namespace {

// The edges of things move by a step from scan to scan.
constexpr std::size_t fewest_steps = 3;

// Where a scanner has not said what it measures: codes of all models are nearer than 20 mm, or as
// far as its characters go.
constexpr double usual_nearest_m = 0.02;
constexpr double usual_farthest_m = 65.0;

std::vector<double> first_echoes(const sim::RecordedScan& scan) {
    std::vector<double> values;
    values.reserve(scan.steps());
    for (std::size_t step = 0; step < scan.steps(); ++step) {
        const auto echoes = scan.ranges_of(step);
        values.push_back(echoes.empty() ? 0.0 : echoes.front());
    }
    return values;
}

bool same_steps(const sim::Directions& a, const sim::Directions& b) {
    return a.first_step == b.first_step && a.cluster == b.cluster;
}

}  // namespace

std::vector<TwinChange> TwinComparison::add(const sim::RecordedScan& scanner,
                                            const sim::RecordedScan& twin,
                                            const sim::ScannerIdentity& identity) {
    ++scans_;
    if (!same_steps(scanner.directions, twin.directions) || scanner.steps() != twin.steps() ||
        scanner.steps() == 0)
        return {};
    const bool others = !pairs_.empty() && (!same_steps(directions_, scanner.directions) ||
                                            pairs_.front().scanner.size() != scanner.steps());
    if (others) pairs_.clear();
    directions_ = scanner.directions;
    nearest_mm_ = 1000.0 * identity.min_range_m.value_or(usual_nearest_m);
    farthest_mm_ = 1000.0 * identity.max_range_m.value_or(usual_farthest_m);
    pairs_.push_back({scans_, scanner.host_time.value_or(sim::HostTime{}), first_echoes(scanner),
                      first_echoes(twin)});
    if (pairs_.size() < scans_together) return {};
    auto changes = tell(look());
    pairs_.clear();
    return changes;
}

bool TwinComparison::is_distance(double value) const {
    return value >= nearest_mm_ && value <= farthest_mm_;
}

/// The middle of the distances, or the most frequent code where that is what most scans have.
double TwinComparison::typical(std::span<const Pair> pairs, Side side, std::size_t step) const {
    std::vector<double> distances;
    std::map<double, std::size_t> codes;
    for (const Pair& pair : pairs) {
        const double value = (pair.*side)[step];
        if (is_distance(value)) {
            distances.push_back(value);
        } else {
            ++codes[value];
        }
    }
    if (2 * distances.size() > pairs.size()) {
        const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
        std::ranges::nth_element(distances, middle);
        return *middle;
    }
    const auto by_count = [](const auto& code) { return code.second; };
    return std::ranges::max_element(codes, {}, by_count)->first;
}

bool TwinComparison::differs(double scanner, double twin) const {
    if (is_distance(scanner) && is_distance(twin)) return std::abs(scanner - twin) > tolerance_mm_;
    return scanner != twin;
}

/// A run is of steps that differ in the same way: nearer, farther, or by codes.
std::vector<TwinDifference> TwinComparison::look() const {
    enum class Way { none, nearer, farther, codes };
    const std::size_t steps = pairs_.front().scanner.size();
    const auto way_at = [&](std::size_t step) {
        const double scanner = typical(pairs_, &Pair::scanner, step);
        const double twin = typical(pairs_, &Pair::twin, step);
        if (!differs(scanner, twin)) return Way::none;
        if (!is_distance(scanner) || !is_distance(twin)) return Way::codes;
        return scanner < twin ? Way::nearer : Way::farther;
    };
    std::vector<Way> ways;
    for (std::size_t step = 0; step < steps; ++step)
        ways.push_back(way_at(step));
    std::vector<TwinDifference> runs;
    for (std::size_t begin = 0; begin < steps;) {
        std::size_t end = begin + 1;
        while (end < steps && ways[end] == ways[begin])
            ++end;
        if (ways[begin] != Way::none && end - begin >= fewest_steps)
            runs.push_back(difference_of(begin, end, ways[begin] == Way::codes));
        begin = end;
    }
    return runs;
}

TwinDifference TwinComparison::difference_of(std::size_t begin, std::size_t end, bool codes) const {
    const std::span<const Pair> since = since_they_differ(begin, end);
    const auto value = [&](Side side) {
        if (codes) return typical(since, side, begin + (end - begin) / 2);
        double sum = 0.0;
        for (std::size_t step = begin; step < end; ++step)
            sum += typical(since, side, step);
        return sum / static_cast<double>(end - begin);
    };
    const auto step_at = [&](std::size_t place) {
        return directions_.first_step.value_or(0) + static_cast<int>(place) * directions_.cluster;
    };
    return {.from = step_at(begin),
            .to = step_at(end) - 1,
            .codes = codes,
            .scanner = value(&Pair::scanner),
            .twin = value(&Pair::twin),
            .scan = since.front().scan,
            .time = since.front().time};
}

/// From the first scan on in which more than half of the steps differ.
std::span<const TwinComparison::Pair> TwinComparison::since_they_differ(std::size_t begin,
                                                                        std::size_t end) const {
    const auto most_differ = [&](const Pair& pair) {
        std::size_t count = 0;
        for (std::size_t step = begin; step < end; ++step)
            count += differs(pair.scanner[step], pair.twin[step]) ? 1 : 0;
        return 2 * count > end - begin;
    };
    const auto first = std::ranges::find_if(pairs_, most_differ);
    return first == pairs_.end() ? std::span(pairs_) : std::span(first, pairs_.end());
}

bool TwinComparison::alike(const TwinDifference& a, const TwinDifference& b) const {
    const int common = std::min(a.to, b.to) - std::max(a.from, b.from) + 1;
    const int wider = std::max(a.to - a.from, b.to - b.from) + 1;
    return a.codes == b.codes && 2 * common > wider &&
           (a.codes || std::abs(a.by_mm() - b.by_mm()) <= tolerance_mm_);
}

/// The steps of a difference that was told and is no more, without those that differ in another
/// way now.
std::vector<TwinDifference> TwinComparison::rest_of(const TwinDifference& old,
                                                    const std::vector<TwinDifference>& now) const {
    std::vector<TwinDifference> rest;
    const auto add = [&](int from, int to) {
        TwinDifference part = old;
        part.from = from;
        part.to = to;
        part.scan = pairs_.front().scan;
        part.time = pairs_.front().time;
        if (to - from + 1 >= static_cast<int>(fewest_steps) * directions_.cluster)
            rest.push_back(part);
    };
    int from = old.from;
    for (const TwinDifference& other : now) {
        if (other.to < from || other.from > old.to) continue;
        add(from, other.from - 1);
        from = other.to + 1;
    }
    add(from, old.to);
    return rest;
}

std::vector<TwinChange> TwinComparison::tell(const std::vector<TwinDifference>& now) {
    std::vector<TwinChange> changes;
    const auto is_in = [this](const std::vector<TwinDifference>& list, const TwinDifference& one) {
        return std::ranges::any_of(list, [&](const auto& other) { return alike(one, other); });
    };
    std::vector<TwinDifference> stay;
    for (const TwinDifference& old : told_) {
        if (is_in(now, old)) {
            stay.push_back(old);
            continue;
        }
        for (const TwinDifference& part : rest_of(old, now))
            changes.push_back({part, false});
    }
    for (const TwinDifference& one : now) {
        if (is_in(stay, one)) continue;
        stay.push_back(one);
        changes.push_back({one, true});
    }
    told_ = std::move(stay);
    return changes;
}

}  // namespace scipd::tools
