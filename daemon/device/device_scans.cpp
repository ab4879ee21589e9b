// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The scans of a device: cast into the world, or played from a recording.
#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <spdlog/spdlog.h>

#include "daemon/device/device.h"
#include "daemon/replay/played_scan.h"
#include "protocol/timestamp.h"

namespace scipd::daemon {

void Device::play(Track track, const ReplayConfig& config) {
    replay_.emplace(std::move(track), config);
    if (config.begins == ReplayStart::start) replay_->begin(replay_turn(0).begins);
    turn_as_recorded(0);
}

// A laser that was switched on just now settles for some turns.
void Device::begin_replay(std::int64_t revolution, bool watched) {
    if (!replay_ || replay_->begun() || revolution < 0) return;
    const protocol::Turn turn{.start = start_of(revolution)};
    const auto takes = [&](const auto* client) { return client->session().has_begun(turn); };
    if (!watched && !std::ranges::any_of(clients_, takes)) return;
    replay_->begin(replay_turn(revolution).begins);
    turn_as_recorded(revolution);
}

// The mirror turned at its own pace meanwhile.
void Device::resume() {
    if (replay_) turn_as_recorded(std::max<std::int64_t>(timing_.revolution_at(uptime()), 0));
}

void Device::turn_as_recorded(std::int64_t revolution) {
    timing_.turn_from(timing_.start(revolution), replay_->lasts(replay_turn(revolution)));
}

ReplayTurn Device::replay_turn(std::int64_t revolution) const {
    const sim::Time begins = device_clock_.world_time(timing_.start(revolution));
    return {.begins = begins, .stamp = clock_.origin() + begins};
}

ReplayStatus Device::replay_status() const {
    return replay_->status(replay_turn(next_revolution()));
}

ReplayStatus Device::steer_replay(const ReplaySteering& steering) {
    const std::int64_t turn = next_revolution();
    ReplayStatus status = replay_->steer(steering, replay_turn(turn));
    turn_as_recorded(turn);
    return status;
}

bool Device::shows(std::int64_t revolution) const {
    return !replay_ || replay_->at(replay_turn(revolution));
}

const ScanRecord& Device::measure(std::int64_t revolution) {
    if (const auto latest = log_.latest(); latest && latest->cast->revolution == revolution)
        return *latest;
    const sim::SensorSpec& optics = sweep_.optics();
    const auto shown = replay_ ? replay_->at(replay_turn(revolution)) : std::nullopt;
    ScanRecord record = shown ? played(revolution, *shown) : cast(revolution);
    record.accuracy = sweep_.accuracy();
    record.stamp_ms = protocol::timestamp_ms(start_of(revolution), state_.clock_zero());
    record.front_step = optics.front_step;
    record.steps_per_turn = optics.steps_per_turn;
    const auto shared = std::make_shared<const ScanRecord>(std::move(record));
    log_.add(shared, clock_.now());
    return *shared;
}

ScanRecord Device::cast(std::int64_t revolution) {
    const auto fired = [&](int step) {
        return device_clock_.world_time(timing_.fired(revolution, step));
    };
    const sim::Time begin = clock_.now();
    const sim::Time start = timing_.start(revolution);
    const CastWatch watch;
    Measurement made =
        sweep_.measure(revolution, device_clock_.world_time(start), fired, clock_.origin(),
                       cold_start_ ? start : sim::Conditions{}.on_for);
    watch.stop(made.backend->backend, counts_);
    std::vector<ReadingFault> faults;
    if (hook_ != nullptr) {
        sim::Scan scan = *made.cast;
        faults = hook_->read(scan, sweep_.optics());
        made.cast = std::make_shared<const sim::Scan>(std::move(scan));
    }
    const auto slow = pace_.add({.backend = made.backend->backend,
                                 .period = timing_.start(revolution + 1) - start,
                                 .many_poses = made.cast->world_from_sensor.size() > 1,
                                 .due = leaves(revolution) + patience_,
                                 .begin = begin,
                                 .end = clock_.now()});
    if (slow) spdlog::warn("{}: {}", sweep_.name(), *slow);
    ScanRecord record{std::move(made)};
    record.faults = std::move(faults);
    record.sent = to_wire(*record.cast, {.start = start_of(revolution)}, sweep_.optics(), profile_);
    return record;
}

// Readings that no fault has changed go out as they were recorded, codes of other firmware too.
ScanRecord Device::played(std::int64_t revolution, const Replay::Shown& shown) {
    TapedScan taped = replay_->tape().scan(shown.scan);
    state_.set_clock(start_of(revolution), std::chrono::milliseconds(shown.stamp_ms));
    const sim::Time start = device_clock_.world_time(timing_.start(revolution));
    sim::Scan scan = played_scan(taped, profile_, revolution, start, sweep_.pose_at(start));
    ScanRecord record{sweep_.measurement_of(nullptr, clock_.origin())};
    record.backend = std::make_shared<const BackendChoice>(BackendChoice{
        .backend = "recording",
        .reason = "the scanner plays " + replay_->status(replay_turn(revolution)).file});
    record.sent = {.turn = {.start = start_of(revolution)},
                   .first_step = sweep_.optics().first_step,
                   .distance = std::move(taped.distance),
                   .intensity = std::move(taped.intensity),
                   .echoes = std::move(taped.echoes)};
    if (hook_ != nullptr) {
        const std::vector<sim::Reading> before = scan.readings;
        record.faults = hook_->read(scan, sweep_.optics());
        put_changed(before, scan.readings, profile_, record.sent);
    }
    record.cast = std::make_shared<const sim::Scan>(std::move(scan));
    return record;
}

}  // namespace scipd::daemon
