// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/replay/replay.h"

#include <algorithm>
#include <chrono>
#include <utility>
#include <variant>

namespace scipd::daemon {
namespace {

constexpr std::uint32_t stamp_mask = (1U << 24U) - 1;
/// A scan begins with a turn that begins as near as this.
constexpr sim::Time nearly = std::chrono::milliseconds(1);
using Scaled = std::chrono::duration<double, sim::Time::period>;

}  // namespace

Track track_of(SharedTape tape) {
    auto line = std::make_shared<LogLine>(tape->recorded(), tape->begin(tape->size()));
    return {.tape = std::move(tape), .line = std::move(line)};
}

Replay::Replay(Track track, const ReplayConfig& config)
    : track_(std::move(track)),
      file_(config.name()),
      loop_(config.loop),
      speed_(config.speed),
      from_(config.from - track_.cut) {
    if (!config.begins_s) return;
    const auto* const stamp = std::get_if<std::chrono::nanoseconds>(&*config.begins_s);
    due_ = stamp != nullptr ? *stamp : track_.line->recorded().value();
}

std::optional<sim::Time> Replay::log_time(const ReplayTurn& turn) const {
    constexpr Scaled farthest = std::chrono::hours(24 * 365 * 100);
    const auto begun = due_ ? due_ : begun_ ? begun_ : track_.line->begun();
    if (!begun || (!due_ && turn.begins < *begun)) return std::nullopt;
    // In floating point, since the difference of two stamps may not fit into a Time.
    const Scaled scaled = (Scaled(due_ ? turn.stamp : turn.begins) - Scaled(*begun)) * speed_;
    const auto since = std::chrono::round<sim::Time>(std::clamp(scaled, -farthest, farthest));
    return rests_at_ ? std::min(from_ + since, *rests_at_) : from_ + since;
}

std::int64_t Replay::next_scan(sim::Time log_time) const {
    const sim::Time whole = track_.line->duration();
    const bool is_first = loop_ == ReplayLoop::none || log_time < whole;
    const std::int64_t round = is_first ? 0 : log_time / whole;
    const std::size_t scan = tape().next(log_time - round * whole - track_.lead);
    return round * static_cast<std::int64_t>(tape().size()) + static_cast<std::int64_t>(scan);
}

sim::Time Replay::begin_of(std::int64_t scan) const {
    const auto scans = static_cast<std::int64_t>(tape().size());
    const std::int64_t round = loop_ == ReplayLoop::none ? 0 : scan / scans;
    const auto index = static_cast<std::size_t>(std::min(scan - round * scans, scans));
    return round * track_.line->duration() + track_.lead + tape().begin(index);
}

std::optional<std::size_t> Replay::index_of(std::int64_t scan) const {
    const auto scans = static_cast<std::int64_t>(tape().size());
    if (loop_ == ReplayLoop::none && scan >= scans) return std::nullopt;
    return static_cast<std::size_t>(scan % scans);
}

std::optional<Replay::Shown> Replay::at(const ReplayTurn& turn) const {
    const auto now = log_time(turn);
    if (!now) return std::nullopt;
    const std::int64_t scan = next_scan(*now - nearly);
    const auto index = index_of(scan);
    const sim::Time begin = begin_of(scan);
    if (!index || begin > *now + nearly || (rests_at_ && begin >= *rests_at_)) return std::nullopt;
    std::uint32_t stamp_ms = tape().stamp_ms(*index);
    if (loop_ == ReplayLoop::on) {
        const auto rounds = scan / static_cast<std::int64_t>(tape().size());
        const auto whole = std::chrono::round<std::chrono::milliseconds>(track_.line->duration());
        stamp_ms += static_cast<std::uint32_t>(rounds * whole.count());
    }
    return Shown{*index, stamp_ms & stamp_mask};
}

// To the next scan. Where that is far, turns like others pass before it.
sim::Time Replay::lasts(const ReplayTurn& turn) const {
    sim::Time duration = tape().lasts(tape().size() - 1);
    if (const auto now = log_time(turn); now && now != rests_at_) {
        const std::int64_t scan = next_scan(*now + nearly);
        const sim::Time next = begin_of(scan) - *now;
        if (next > sim::Time::zero() && next <= 2 * duration) duration = next;
    }
    const auto scaled = std::chrono::round<sim::Time>(Scaled(duration) / speed_);
    return std::max(scaled, sim::Time(std::chrono::milliseconds(1)));
}

ReplayStatus Replay::steer(const ReplaySteering& steering, const ReplayTurn& turn) {
    if (const auto now = log_time(turn)) {
        from_ = *now;
        due_.reset();
        begun_ = turn.begins;
    } else if (steering.step || steering.paused == false) {
        begun_ = turn.begins;  // no client has come, and none is waited for any more
    }
    if (steering.at) from_ = track_.lead + tape().begin(tape().at(*steering.at));
    if (steering.speed) speed_ = *steering.speed;
    const bool rests = steering.step || steering.paused.value_or(rests_at_.has_value());
    rests_at_.reset();
    if (rests) rests_at_ = begin_of(next_scan(from_ - nearly) + steering.step.value_or(0));
    return status_at(rests ? rests_at_ : log_time(turn));
}

ReplayStatus Replay::status_at(std::optional<sim::Time> log_time) const {
    const auto scan = index_of(next_scan(log_time.value_or(from_) - nearly));
    const std::size_t next = scan.value_or(tape().size());
    const bool rests = rests_at_ && log_time.value_or(from_) + nearly >= *rests_at_;
    return {.file = file_,
            .state = !scan      ? "over"
                     : rests    ? "paused"
                     : log_time ? "playing"
                                : "waiting",
            .speed = speed_,
            .scan = next,
            .scans = tape().size(),
            .at = tape().begin(next),
            .duration = tape().begin(tape().size())};
}

}  // namespace scipd::daemon
