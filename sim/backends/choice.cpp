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
/// A contender that takes so many times as long as the yardstick casts no more.
constexpr double hopeless = 4.0;

/// How many poses of a sweep are cast first, and by how much their number grows where that was
/// quick.
constexpr std::size_t first_poses = 16;
constexpr std::size_t growth = 4;
/// A cast that takes more than this part of the budget is long enough to measure by.
constexpr int casts_in_budget = 32;

// The error bound: as published for 30 m. Beams at edges may meet either side, so a few may differ.
constexpr float bound_m = 5e-3F;
constexpr double beams_beyond = 0.01;

/// The poses that differ from the one before, by index.
std::vector<std::size_t> pose_begins(const Fan& fan) {
    std::vector<std::size_t> begins{0};
    for (std::size_t i = 1; i < fan.world_from_sensor.size(); ++i) {
        if (fan.world_from_sensor[i] != fan.world_from_sensor[i - 1]) begins.push_back(i);
    }
    return begins;
}

/// The part of the sweep that has this many poses and lies in its middle.
Fan middle_of(const Fan& fan, std::size_t poses) {
    const std::vector<std::size_t> begins = pose_begins(fan);
    if (poses >= begins.size()) return fan;
    const std::size_t first = (begins.size() - poses) / 2;
    const std::size_t pose = begins[first];
    const std::size_t count = begins[first + poses] - pose;
    const std::size_t each = fan.directions_per_pose;
    Fan part = fan;
    part.directions = fan.directions.subspan(pose * each, count * each);
    part.world_from_sensor = fan.world_from_sensor.subspan(pose, count);
    return part;
}

/// A contender and what it has cast so far.
struct Runner {
    Contender contender;
    std::vector<std::optional<Time>> best;  ///< for each fan
    std::vector<std::vector<Hit>> hits;     ///< of each fan, the last

    /// The best times for the first `fans` fans, which have all been timed, together.
    [[nodiscard]] Time total(std::size_t fans) const {
        Time sum{};
        for (std::size_t i = 0; i < fans; ++i)
            sum += *best[i];
        return sum;
    }
};

class Race {
  public:
    Race(std::span<const Contender> contenders, std::span<const Fan> fans,
         const std::function<Time()>& now, const ChoiceLimits& limits)
        : whole_(fans),
          parts_(fans.begin(), fans.end()),
          all_poses_(pose_begins(fans.front()).size()),
          now_(now),
          limits_(limits),
          begin_(now()) {
        for (const Contender& contender : contenders) {
            runners_.push_back({contender, std::vector<std::optional<Time>>(fans.size()),
                                std::vector<std::vector<Hit>>(fans.size())});
        }
    }

    /// Casts more and more of a sweep, until it is the whole or takes long enough to measure by.
    /// This also warms up caches, plans and shaders.
    void settle_share() {
        for (poses_ = std::min(first_poses, all_poses_);;
             poses_ = std::min(growth * poses_, all_poses_)) {
            std::ranges::transform(whole_, parts_.begin(),
                                   [&](const Fan& fan) { return middle_of(fan, poses_); });
            bool long_enough = poses_ == all_poses_;
            for (Runner& runner : runners_) {
                if (ended()) return;
                // Twice, since the first cast may be slow because of what is done only once.
                const bool slow = is_slow(cast(runner, 0)) && !long_enough;
                if (ended()) return;
                long_enough = long_enough || (slow && is_slow(cast(runner, 0)));
            }
            if (long_enough) return;
        }
    }

    /// Lets all cast in turn, for several rounds, so that whatever else the machine does slows all
    /// of them down. Everybody casts the first fan, whatever the budget says.
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
    /// Says for people which part of a sweep was cast; empty where it was all of it.
    [[nodiscard]] std::string share() const {
        if (poses_ == all_poses_) return {};
        return ", measured on " + std::to_string(poses_) + " of its " + std::to_string(all_poses_) +
               " poses";
    }

  private:
    Time cast(Runner& runner, std::size_t fan) {
        runner.hits[fan].resize(parts_[fan].directions.size());
        const Time begin = now_();
        runner.contender.backend->cast(parts_[fan], runner.hits[fan]);
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
    std::vector<std::string> figures;
    for (std::size_t i = 0; i < runners.size(); ++i) {
        const Time took = runners[i].total(fans);
        figures.push_back(milliseconds(took, fans));
        const double beyond = share_beyond(runners[i], runners.front(), fans);
        if (beyond > beams_beyond) {
            figures.back() += in_text(", but differs in %.1f %% of the beams", 100.0 * beyond);
        } else if (took < clearly * runners[choice.contender].total(fans)) {
            choice.contender = i;
        }
    }
    choice.reason = figures[choice.contender] + " per scan" + race.share();
    for (std::size_t i = 0; i < runners.size(); ++i) {
        if (i != choice.contender)
            choice.reason += "; " + std::string(runners[i].contender.name) + ": " + figures[i];
    }
    return choice;
}

}  // namespace

Choice choose(std::span<const Contender> contenders, std::span<const Fan> fans,
              const std::function<Time()>& now, const ChoiceLimits& limits) {
    assert(!contenders.empty() && !fans.empty());
    Race race(contenders, fans, now, limits);
    race.settle_share();
    race.run();
    if (race.ended()) return {0, "measuring was ended"};
    return judge(race);
}

}  // namespace scipd::sim
