// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where B gives other codes than A, or distances where A gives codes.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/scipcat/compare/difference_parts.h"
#include "tools/scipcat/compare/window_test.h"

namespace scipd::tools::comparing {
namespace {

/// Smaller differences of a share are none.
constexpr double least_share = 0.002;

std::vector<bool> comparable_pairs(const Matter& matter) {
    std::vector<bool> comparable;
    for (const BeamPair& pair : matter.pairs)
        comparable.push_back(pair.comparable);
    return comparable;
}

Tables table_of(const Matter& matter, Code code) {
    Tables tables(matter);
    tables.a.fill([&](std::size_t scan, std::size_t pair) {
        return class_of(matter.a.code(scan, matter.pairs[pair].a)) == code ? 1.0 : 0.0;
    });
    tables.b.fill([&](std::size_t scan, std::size_t pair) {
        return class_of(matter.b.code(scan, matter.pairs[pair].b)) == code ? 1.0 : 0.0;
    });
    return tables;
}

double share_at(const BlockTable& table, std::size_t pair) {
    double sum = 0;
    double count = 0;
    for (std::size_t block = 0; block < table.blocks(); ++block) {
        sum += table.sum(block, pair);
        count += table.count(block, pair);
    }
    return sum / count;
}

/// The effects on the share of one code: that whose share changes most in the fan.
Effects effects_of_share(const Matter& matter, const Tables& tables) {
    const auto scans = static_cast<double>(std::min(matter.a.scans(), matter.b.scans()));
    Effects effects;
    for (std::size_t pair = 0; pair < matter.pairs.size(); ++pair) {
        const double a = share_at(tables.a, pair);
        const double b = share_at(tables.b, pair);
        const double middle = ((a + b) / 2 * scans + 0.5) / (scans + 1);
        effects.values.push_back(b - a);
        effects.deviations.push_back(std::sqrt(2 * middle * (1 - middle) / scans));
    }
    return effects;
}

std::vector<std::size_t> beams_in(const Matter& matter, const Run& run, bool of_a) {
    std::vector<std::size_t> beams;
    for (std::size_t pair = run.first; pair <= run.last; ++pair) {
        if (matter.pairs[pair].comparable)
            beams.push_back(of_a ? matter.pairs[pair].a : matter.pairs[pair].b);
    }
    return beams;
}

double share_of(const CodeShares& shares, Code code) {
    const auto found = shares.find(code);
    return found == shares.end() ? 0 : found->second;
}

/// The share of the code in A's second half, less that in its first.
double drift_of_share(const Matter& matter, const Run& run, Code code) {
    const auto beams = beams_in(matter, run, true);
    const std::size_t middle = matter.a.scans() / 2;
    return share_of(code_shares(matter.a, beams, {middle, matter.a.scans()}), code) -
           share_of(code_shares(matter.a, beams, {0, middle}), code);
}

/// Codes whose shares are the same in the run are no part of it.
void keep_what_differs(Difference& difference, const CodeShares& a, const CodeShares& b) {
    const double most = std::abs(difference.difference());
    for (const auto& shares : {a, b}) {
        for (const auto& [code, share] : shares) {
            if (std::abs(share_of(b, code) - share_of(a, code)) < most / 10) continue;
            difference.codes_a[code] = share_of(a, code);
            difference.codes_b[code] = share_of(b, code);
        }
    }
}

/// The code whose share changes most.
Code most_changed(const CodeShares& a, const CodeShares& b, const std::vector<Code>& codes) {
    return *std::ranges::max_element(
        codes, {}, [&](Code code) { return std::abs(share_of(b, code) - share_of(a, code)); });
}

std::optional<Difference> judge(const Matter& matter, const Run& run,
                                const std::vector<Code>& codes, const std::vector<Tables>& tables) {
    const CodeShares a = code_shares(matter.a, beams_in(matter, run, true), all_scans(matter.a));
    const CodeShares b = code_shares(matter.b, beams_in(matter, run, false), all_scans(matter.b));
    const Code code = most_changed(a, b, codes);
    Difference difference = difference_at(matter, What::codes, run);
    difference.a = share_of(a, code);
    difference.b = share_of(b, code);
    difference.effect = std::numeric_limits<double>::quiet_NaN();
    const double least = std::max(least_share, std::abs(drift_of_share(matter, run, code)));
    if (std::abs(difference.difference()) <= least) return std::nullopt;
    std::vector<double> weights;
    for (const BeamPair& pair : matter.pairs)
        weights.push_back(pair.comparable ? 1 : 0);
    const auto at = static_cast<std::size_t>(std::ranges::find(codes, code) - codes.begin());
    difference.by = drawn_interval(
        tables[at], run, weights,
        [](const Drawn& one, const Drawn& other) { return other.mean() - one.mean(); });
    if (difference.by.holds(0)) return std::nullopt;
    keep_what_differs(difference, a, b);
    return difference;
}

}  // namespace

std::vector<Code> codes_to_compare(const Matter& matter) {
    constexpr double rarest = 1e-4;
    constexpr std::size_t most = 8;
    CodeShares shares = code_shares(matter.a);
    for (const auto& [code, share] : code_shares(matter.b))
        shares[code] = std::max(share, shares[code]);
    std::vector<Code> codes;
    for (const auto& [code, share] : shares) {
        if (share >= rarest) codes.push_back(code);
    }
    std::ranges::sort(codes, {}, [&](Code code) { return -shares[code]; });
    if (codes.size() > most) codes.resize(most);
    return codes;
}

std::vector<Difference> code_differences(const Matter& matter, const std::vector<Code>& codes,
                                         double chance) {
    if (codes.empty()) return {};
    const auto tested = comparable_pairs(matter);
    std::vector<Tables> tables;
    std::vector<int> differing(matter.pairs.size(), 0);
    Effects most;
    for (const Code code : codes) {
        const Tables& table = tables.emplace_back(table_of(matter, code));
        const auto signs = find_differing(table.a, table.b, tested,
                                          {.quantity = Quantity::shares, .chance = chance});
        const Effects effects = effects_of_share(matter, table);
        if (most.values.empty()) most = effects;
        for (std::size_t pair = 0; pair < signs.size(); ++pair) {
            if (signs[pair] == 0) continue;
            differing[pair] = 1;
            if (std::abs(effects.values[pair]) <= std::abs(most.values[pair])) continue;
            most.values[pair] = effects.values[pair];
            most.deviations[pair] = effects.deviations[pair];
        }
    }
    std::vector<Difference> differences;
    for (const Run& run : runs_of(differing, most)) {
        if (auto difference = judge(matter, run, codes, tables))
            differences.push_back(*std::move(difference));
    }
    return differences;
}

}  // namespace scipd::tools::comparing
