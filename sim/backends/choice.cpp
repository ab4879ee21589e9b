// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/choice.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <vector>

namespace scipd::sim {
namespace {

/// The first round only warms up: caches, plans, shaders.
constexpr int rounds = 6;
/// Who has taken so much longer than the yardstick is not waited for any longer.
constexpr double hopeless = 4.0;

// The error bound: as published for 30 m, and beams at edges may take either side.
constexpr float bound_m = 5e-3F;
constexpr double beams_beyond = 0.01;

/// Somebody who is still in.
struct Runner {
    RangeBackend* backend;
    std::vector<Time> took;      ///< for all fans, each round
    std::vector<Hit> last_hits;  ///< of all fans

    [[nodiscard]] Time best() const { return *std::ranges::min_element(took); }
};

void run(Runner& runner, std::span<const Fan> fans, const std::function<Time()>& now) {
    std::size_t beams = 0;
    for (const Fan& fan : fans)
        beams += fan.directions.size();
    runner.last_hits.resize(beams);
    std::span<Hit> hits{runner.last_hits};
    const Time begin = now();
    for (const Fan& fan : fans) {
        runner.backend->cast(fan, hits.first(fan.directions.size()));
        hits = hits.subspan(fan.directions.size());
    }
    runner.took.push_back(now() - begin);
}

/// Several rounds, in turn, so that whatever else the machine does meets all.
void race(std::vector<Runner>& runners, std::span<const Fan> fans,
          const std::function<Time()>& now) {
    for (int round = 0; round < rounds; ++round) {
        for (Runner& runner : runners) {
            const bool behind = round > 1 && runner.best() > hopeless * runners.front().best();
            if (!behind) run(runner, fans, now);
        }
        if (round == 0) {
            for (Runner& runner : runners)
                runner.took.clear();
        }
    }
}

bool agree(const Hit& hit, const Hit& truth) {
    if (!hit.met() || !truth.met()) return hit.met() == truth.met();
    return std::abs(hit.range_m - truth.range_m) <= bound_m;
}

bool clearly_faster(const Runner& runner, const Runner& other) {
    constexpr double clearly = 0.9;
    return runner.best() < clearly * other.best();
}

double share_beyond(const Runner& runner, const Runner& yardstick) {
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < runner.last_hits.size(); ++i) {
        if (!agree(runner.last_hits[i], yardstick.last_hits[i])) ++beyond;
    }
    return double(beyond) / double(std::max<std::size_t>(1, runner.last_hits.size()));
}

std::string in_text(const char* format, double number) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), format, number);
    return text.data();
}

std::string milliseconds(Time time, std::size_t fans) {
    const double ms = std::chrono::duration<double, std::milli>(time).count();
    return in_text("%.3f ms", ms / double(fans));
}

}  // namespace

Choice choose(std::span<RangeBackend* const> contenders, std::span<const Fan> fans,
              const std::function<Time()>& now) {
    assert(!contenders.empty() && !fans.empty());
    std::vector<Runner> runners;
    for (RangeBackend* contender : contenders)
        runners.push_back({contender, {}, {}});
    race(runners, fans, now);
    const Runner& yardstick = runners.front();
    Choice choice;
    for (std::size_t i = 0; i < runners.size(); ++i) {
        const Runner& runner = runners[i];
        choice.reason += (i == 0 ? "" : ", ") + std::string(runner.backend->name()) + " takes " +
                         milliseconds(runner.best(), fans.size());
        const double beyond = share_beyond(runner, yardstick);
        if (beyond > beams_beyond) {
            choice.reason += in_text(" but differs in %.1f %% of the beams", 100.0 * beyond);
        } else if (clearly_faster(runner, runners[choice.contender])) {
            choice.contender = i;
        }
    }
    return choice;
}

}  // namespace scipd::sim
