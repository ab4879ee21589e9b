// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/scan_timing.h"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace scipd::sim {
namespace {

// Nobody asks for turns of long ago, but a client may change the speed as often as it likes.
constexpr std::size_t most_spells = 16;

/// Rounded down, also below zero.
std::int64_t whole_periods(Time time, Time period) {
    const std::int64_t toward_zero = time / period;
    return time % period < Time::zero() ? toward_zero - 1 : toward_zero;
}

}  // namespace

ScanTiming::ScanTiming(const SensorSpec& spec, Time epoch)
    : steps_per_turn_(spec.steps_per_turn),
      last_step_(spec.last_step),
      spells_{{.origin = epoch, .period = spec.scan_period}} {
    assert(spec.scan_period > Time::zero());
}

void ScanTiming::turn_from(Time origin, Time period) {
    if (spells_.back().origin == origin && spells_.back().period == period) return;
    const std::int64_t first = revolution_at(origin - Time(1)) + 1;
    while (spells_.size() > 1 && spells_.back().origin >= origin)
        spells_.pop_back();
    spells_.push_back({first, origin, period});
    if (spells_.size() > most_spells) spells_.erase(spells_.begin());
}

Time ScanTiming::start(std::int64_t revolution) const {
    const Spell& spell = spell_of(revolution);
    return spell.origin + (revolution - spell.first) * spell.period;
}

Time ScanTiming::fired(std::int64_t revolution, int step) const {
    return start(revolution) + spell_of(revolution).period * step / steps_per_turn_;
}

Time ScanTiming::complete(std::int64_t revolution) const {
    return fired(revolution, last_step_);
}

std::int64_t ScanTiming::revolution_at(Time time) const {
    const auto later = std::find_if(std::next(spells_.begin()), spells_.end(),
                                    [&](const Spell& spell) { return spell.origin > time; });
    const Spell& spell = *std::prev(later);
    return spell.first + whole_periods(time - spell.origin, spell.period);
}

std::int64_t ScanTiming::latest_complete(Time time) const {
    const std::int64_t under_way = revolution_at(time);
    return complete(under_way) <= time ? under_way : under_way - 1;
}

const ScanTiming::Spell& ScanTiming::spell_of(std::int64_t revolution) const {
    const auto later = std::find_if(std::next(spells_.begin()), spells_.end(),
                                    [&](const Spell& spell) { return spell.first > revolution; });
    return *std::prev(later);
}

}  // namespace scipd::sim
