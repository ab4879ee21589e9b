// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/proxy/twin_comparison.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <utility>

#include <nlohmann/json.hpp>

#include "tools/analysis/beam_statistics.h"
#include "tools/formatted.h"
#include "tools/local_time.h"

namespace scipd::tools {
namespace {

// The edges of things move by a step from scan to scan.
constexpr std::size_t fewest_steps = 3;

bool same_steps(const sim::RecordedScan& a, const sim::RecordedScan& b) {
    return a.steps() == b.steps() && a.directions.first_step == b.directions.first_step &&
           a.directions.cluster == b.directions.cluster;
}

/// The median of the distances from row `first` on, or the most frequent code if most have none.
Reading typical(const ScanTable& table, std::size_t first, std::size_t beam) {
    std::vector<double> distances;
    std::map<Code, std::size_t> codes;
    for (std::size_t scan = first; scan < table.scans(); ++scan) {
        if (is_distance(table.range_mm(scan, beam))) {
            distances.push_back(table.range_mm(scan, beam));
        } else {
            ++codes[table.code(scan, beam)];
        }
    }
    if (2 * distances.size() > table.scans() - first)
        return {.range_mm = static_cast<float>(median_of(std::move(distances))),
                .code = codes::distance};
    const auto by_count = [](const auto& code) { return code.second; };
    return {.code = std::ranges::max_element(codes, {}, by_count)->first};
}

std::string steps_of(const TwinDifference& difference) {
    return "steps " + std::to_string(difference.from) + "-" + std::to_string(difference.to);
}

std::string how(const TwinDifference& difference) {
    if (difference.codes) {
        return formatted(" read %.0f, the twin's %.0f", difference.scanner, difference.twin);
    }
    const double by_mm = difference.by_mm();
    return (by_mm < 0 ? " nearer by " : " farther by ") +
           formatted("%.2f m", std::abs(by_mm) / 1e3);
}

}  // namespace

std::vector<TwinChange> TwinComparison::add(const sim::RecordedScan& scanner,
                                            const sim::RecordedScan& twin,
                                            const sim::ScannerIdentity& identity) {
    ++scans_;
    if (!same_steps(scanner, twin) || scanner.steps() == 0) return {};
    if (!scanner_.looks_alike(scanner)) clear();
    scanner_.identity = identity;
    twin_.identity = identity;
    scanner_.append(scanner);
    twin_.append(twin);
    rows_.push_back({scans_, scanner.host_time.value_or(sim::HostTime{})});
    if (rows_.size() < scans_together) return {};
    auto changes = tell(look());
    clear();
    return changes;
}

void TwinComparison::clear() {
    scanner_.clear();
    twin_.clear();
    rows_.clear();
}

bool TwinComparison::differs(const Reading& scanner, const Reading& twin) const {
    if (is_distance(scanner.range_mm) && is_distance(twin.range_mm))
        return std::abs(scanner.range_mm - twin.range_mm) > tolerance_mm_;
    return class_of(scanner.code) != class_of(twin.code);
}

/// A run is of steps that differ in the same way: nearer, farther, or by codes.
std::vector<TwinDifference> TwinComparison::look() const {
    enum class Way { none, nearer, farther, codes };
    const std::size_t steps = scanner_.beams;
    const auto way_at = [&](std::size_t step) {
        const Reading scanner = typical(scanner_, 0, step);
        const Reading twin = typical(twin_, 0, step);
        if (!differs(scanner, twin)) return Way::none;
        if (!is_distance(scanner.range_mm) || !is_distance(twin.range_mm)) return Way::codes;
        return scanner.range_mm < twin.range_mm ? Way::nearer : Way::farther;
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
    const std::size_t since = since_they_differ(begin, end);
    const auto value = [&](const ScanTable& table) {
        if (codes) {
            const Reading middle = typical(table, since, begin + (end - begin) / 2);
            return is_distance(middle.range_mm) ? double{middle.range_mm}
                                                : std::max<double>(middle.code, 0.0);
        }
        double sum = 0.0;
        double count = 0.0;
        for (std::size_t step = begin; step < end; ++step) {
            const Reading reading = typical(table, since, step);
            if (!is_distance(reading.range_mm)) continue;
            sum += reading.range_mm;
            ++count;
        }
        return sum / count;
    };
    return {.from = scanner_.step_of(begin),
            .to = scanner_.step_of(end) - 1,
            .codes = codes,
            .scanner = value(scanner_),
            .twin = value(twin_),
            .scan = rows_[since].scan,
            .time = rows_[since].time};
}

/// The first row in which more than half of the steps differ, or 0.
std::size_t TwinComparison::since_they_differ(std::size_t begin, std::size_t end) const {
    for (std::size_t row = 0; row < rows_.size(); ++row) {
        std::size_t count = 0;
        for (std::size_t step = begin; step < end; ++step) {
            const bool differ = differs(scanner_.reading(row, step), twin_.reading(row, step));
            count += differ ? 1 : 0;
        }
        if (2 * count > end - begin) return row;
    }
    return 0;
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
        part.scan = rows_.front().scan;
        part.time = rows_.front().time;
        if (to - from + 1 >= static_cast<int>(fewest_steps) * scanner_.directions.cluster)
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

std::string sentence_of(const TwinChange& change) {
    const TwinDifference& difference = change.difference;
    return steps_of(difference) +
           (change.begins ? how(difference) : " agree with the twin's again") + ", since scan " +
           std::to_string(difference.scan) + " at " + local_time(difference.time, "%T");
}

std::string json_of(const TwinChange& change) {
    const TwinDifference& difference = change.difference;
    const std::chrono::duration<double> unix_s = difference.time.time_since_epoch();
    const nlohmann::ordered_json object{
        {"differs", change.begins}, {"from", difference.from},
        {"to", difference.to},      {"what", difference.codes ? "codes" : "mean"},
        {"a", difference.scanner},  {"b", difference.twin},
        {"scan", difference.scan},  {"time_s", unix_s.count()}};
    return object.dump();
}

}  // namespace scipd::tools
