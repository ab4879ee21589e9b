// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/device/staring_sensor.h"

#include <algorithm>

#include <spdlog/spdlog.h>

#include "sim/fnv1a.h"

namespace scipd::daemon {
namespace {

/// Large pictures are not kept for a second.
std::size_t log_capacity(const sim::StaringSpec& spec) {
    constexpr int most_beams = 2'000'000;
    return static_cast<std::size_t>(std::clamp(most_beams / spec.beams(), 1, 64));
}

sim::ErrorModel errors_of(const std::string& robot, const SensorConfig& config,
                          std::uint64_t seed) {
    return {.accuracy = config.accuracy,
            .seed = seed,
            .sensor = sim::fnv1a<std::uint64_t>(sensor_name(robot, config.name))};
}

// As many poses as beams, said as a number: its beams are no plane that turns.
SensorConfig in_poses(SensorConfig config) {
    config.motion = config.motion.value_or(config.staring->beams());
    return config;
}

}  // namespace

StaringSensor::StaringSensor(const std::string& robot, const SensorConfig& config,
                             std::uint64_t seed, World& world, Clock& clock)
    : staring_(*config.staring, errors_of(robot, config, seed)),
      sweep_(world, robot, in_poses(config), staring_.make_scanner()),
      clock_(clock),
      first_(clock.now()),
      patience_(config.wait_for_poses),
      rolling_(config.motion != 1),
      log_(log_capacity(spec())) {}

void StaringSensor::watch(std::function<void(const StaringRecord&)> watcher, WatchedBy who) {
    watchers_.set(who, std::move(watcher));
    if (watchers_.any() && on_wanted_) on_wanted_();
}

std::int64_t StaringSensor::number_at(sim::Time time) const {
    return (time - first_) / spec().period;
}

std::int64_t StaringSensor::next_revolution() const {
    return number_at(clock_.now()) + 1;
}

sim::Time StaringSensor::leaves(std::int64_t number) const {
    return first_ + number * spec().period;
}

bool StaringSensor::poses_known(std::int64_t number) const {
    return sweep_.poses_known(leaves(number));
}

void StaringSensor::turn_complete(std::int64_t number) {
    if (!watchers_.any()) return;
    watchers_.tell(*measure(number));
    counts_.lateness.add(clock_.now() - leaves(number));
}

SharedStaringRecord StaringSensor::latest() {
    const sim::Time now = clock_.now();
    std::int64_t number = number_at(now);
    while (number > 0 && now < leaves(number) + patience_ && !poses_known(number))
        --number;
    return measure(number);
}

// One pose is that of the instant. More are of the period before it, as pixels that are read out
// one after the other, so that nothing is to come when it is here.
SharedStaringRecord StaringSensor::measure(std::int64_t number) {
    if (auto known = log_.find(number)) return known;
    const sim::Time instant = leaves(number);
    const auto fired = [&](int beam) {
        const int left = spec().beams() - 1 - beam;
        return rolling_ ? instant - spec().period * left / spec().beams() : instant;
    };
    const sim::Time begin = clock_.now();
    const CastWatch watch;
    StaringRecord record{sweep_.measure(number, instant, fired, clock_.origin())};
    watch.stop(record.backend->backend, counts_);
    record.spec = spec();
    record.range_m = staring_.read(*record.cast);
    if (watchers_.any()) note_pace(record, begin);
    ++counts_.scans;
    const auto shared = std::make_shared<const StaringRecord>(std::move(record));
    log_.add(shared, begin);
    return shared;
}

// Only of those that are measured one after the other: who asks now and then loses none, and is as
// late as it likes.
void StaringSensor::note_pace(const StaringRecord& record, sim::Time begin) {
    const auto slow = pace_.add({.backend = record.backend->backend,
                                 .period = spec().period,
                                 .many_poses = record.cast->world_from_sensor.size() > 1,
                                 .due = record.cast->start + patience_,
                                 .begin = begin,
                                 .end = clock_.now()});
    if (slow) spdlog::warn("{}: {}", sweep_.name(), *slow);
}

}  // namespace scipd::daemon
