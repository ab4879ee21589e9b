// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/choice.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

namespace scipd::sim {
namespace {

constexpr int rounds = 5;
/// Who has taken so much longer than the yardstick is not waited for any longer.
constexpr double hopeless = 4.0;

/// What is cast first of a sweep, and by how much the share grows where that was quick.
constexpr std::size_t first_poses = 16;
constexpr std::size_t growth = 4;
/// A cast that takes more of the budget is long enough to tell by.
constexpr int casts_in_budget = 32;

// The error bound: as published for 30 m, and beams at edges may take either side.
constexpr float bound_m = 5e-3F;
constexpr double beams_beyond = 0.01;

/// Where another pose begins.
std::vector<std::size_t> pose_begins(const Fan& fan) {
    std::vector<std::size_t> begins{0};
    for (std::size_t i = 1; i < fan.world_from_sensor.size(); ++i) {
        if (fan.world_from_sensor[i] != fan.world_from_sensor[i - 1]) begins.push_back(i);
    }
    return begins;
}

/// The beams of so many poses in the middle of the sweep.
Fan middle_of(const Fan& fan, std::size_t poses) {
    const std::vector<std::size_t> begins = pose_begins(fan);
    if (poses >= begins.size()) return fan;
    const std::size_t first = (begins.size() - poses) / 2;
    const std::size_t beam = begins[first];
    const std::size_t beams = begins[first + poses] - beam;
    Fan part = fan;
    part.directions = fan.directions.subspan(beam, beams);
    part.world_from_sensor = fan.world_from_sensor.subspan(beam, beams);
    return part;
}

/// Somebody who is still in.
struct Runner {
    RangeBackend* backend;
    std::vector<std::optional<Time>> best;  ///< for each fan
    std::vector<std::vector<Hit>> hits;     ///< of each fan, the last

    /// For the first fans, which have all been timed.
    [[nodiscard]] Time total(std::size_t fans) const {
        Time sum{};
        for (std::size_t i = 0; i < fans; ++i)
            sum += *best[i];
        return sum;
    }
};

class Race {
  public:
    Race(std::span<RangeBackend* const> contenders, std::span<const Fan> fans,
         const std::function<Time()>& now, const ChoiceLimits& limits)
        : whole_(fans),
          parts_(fans.begin(), fans.end()),
          all_poses_(pose_begins(fans.front()).size()),
          now_(now),
          limits_(limits),
          begin_(now()) {
        for (RangeBackend* contender : contenders) {
            runners_.push_back({contender, std::vector<std::optional<Time>>(fans.size()),
                                std::vector<std::vector<Hit>>(fans.size())});
        }
    }

    /// Casts more and more of a sweep, until it is the whole or takes long enough to tell by. Warms
    /// up as well: caches, plans, shaders.
    void settle_share() {
        for (poses_ = std::min(first_poses, all_poses_);;
             poses_ = std::min(growth * poses_, all_poses_)) {
            std::ranges::transform(whole_, parts_.begin(),
                                   [&](const Fan& fan) { return middle_of(fan, poses_); });
            bool long_enough = poses_ == all_poses_;
            for (Runner& runner : runners_) {
                if (ended()) return;
                // Not because of what is done once, or of something else on this machine.
                const bool slow = is_slow(cast(runner, 0)) && !long_enough;
                if (ended()) return;
                long_enough = long_enough || (slow && is_slow(cast(runner, 0)));
            }
            if (long_enough) return;
        }
    }

    /// Several rounds, in turn, so that whatever else the machine does meets all. The first fan
    /// counts in any case.
    void run() {
        for (int round = 0; round < rounds; ++round) {
            for (std::size_t fan = 0; fan < parts_.size(); ++fan) {
                if (timed_fans_ > 0 && over()) return;
                for (Runner& runner : runners_) {
                    if (ended()) return;
                    if (round > 0 && behind(runner)) continue;
                    const Time took = cast(runner, fan);
                    runner.best[fan] = std::min(runner.best[fan].value_or(took), took);
                }
                timed_fans_ = std::max(timed_fans_, fan + 1);
            }
        }
    }

    [[nodiscard]] bool ended() const { return limits_.ended && limits_.ended(); }
    [[nodiscard]] std::span<const Runner> runners() const { return runners_; }
    [[nodiscard]] std::size_t timed_fans() const { return timed_fans_; }
    /// What of a sweep was cast, for people; empty: all.
    [[nodiscard]] std::string share() const {
        if (poses_ == all_poses_) return {};
        return ", each for " + std::to_string(poses_) + " of the " + std::to_string(all_poses_) +
               " poses of a sweep";
    }

  private:
    Time cast(Runner& runner, std::size_t fan) {
        runner.hits[fan].resize(parts_[fan].directions.size());
        const Time begin = now_();
        runner.backend->cast(parts_[fan], runner.hits[fan]);
        return now_() - begin;
    }
    [[nodiscard]] bool is_slow(Time took) const { return took > limits_.budget / casts_in_budget; }
    [[nodiscard]] bool over() const { return now_() - begin_ > limits_.budget; }
    [[nodiscard]] bool behind(const Runner& runner) const {
        return runner.total(timed_fans_) > hopeless * runners_.front().total(timed_fans_);
    }

    std::span<const Fan> whole_;
    std::vector<Fan> parts_;
    std::size_t all_poses_;
    std::size_t poses_ = 0;  ///< of a part
    const std::function<Time()>& now_;
    const ChoiceLimits& limits_;
    Time begin_;
    std::vector<Runner> runners_;
    std::size_t timed_fans_ = 0;  ///< by all runners
};

bool agree(const Hit& hit, const Hit& truth) {
    if (!hit.met() || !truth.met()) return hit.met() == truth.met();
    return std::abs(hit.range_m - truth.range_m) <= bound_m;
}

double share_beyond(const Runner& runner, const Runner& yardstick, std::size_t fans) {
    std::size_t beams = 0;
    std::size_t beyond = 0;
    for (std::size_t fan = 0; fan < fans; ++fan) {
        beams += runner.hits[fan].size();
        for (std::size_t i = 0; i < runner.hits[fan].size(); ++i) {
            if (!agree(runner.hits[fan][i], yardstick.hits[fan][i])) ++beyond;
        }
    }
    return double(beyond) / double(std::max<std::size_t>(1, beams));
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

Choice judge(const Race& race) {
    constexpr double clearly = 0.9;
    const std::span<const Runner> runners = race.runners();
    const std::size_t fans = race.timed_fans();
    Choice choice;
    for (std::size_t i = 0; i < runners.size(); ++i) {
        const Time took = runners[i].total(fans);
        choice.reason += (i == 0 ? "" : ", ") + std::string(runners[i].backend->name()) +
                         " takes " + milliseconds(took, fans);
        const double beyond = share_beyond(runners[i], runners.front(), fans);
        if (beyond > beams_beyond) {
            choice.reason += in_text(" but differs in %.1f %% of the beams", 100.0 * beyond);
        } else if (took < clearly * runners[choice.contender].total(fans)) {
            choice.contender = i;
        }
    }
    choice.reason += race.share();
    return choice;
}

}  // namespace

Choice choose(std::span<RangeBackend* const> contenders, std::span<const Fan> fans,
              const std::function<Time()>& now, const ChoiceLimits& limits) {
    assert(!contenders.empty() && !fans.empty());
    Race race(contenders, fans, now, limits);
    race.settle_share();
    race.run();
    if (race.ended()) return {0, "measuring was ended"};
    return judge(race);
}

}  // namespace scipd::sim
