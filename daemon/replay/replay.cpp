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
/// On the line of stamps a scan begins with a turn that begins as near as this.
constexpr sim::Time nearly = std::chrono::milliseconds(1);
using Scaled = std::chrono::duration<double, sim::Time::period>;

}  // namespace

Replay::Replay(SharedTape tape, const ReplayConfig& config)
    : tape_(std::move(tape)),
      file_(config.name()),
      loop_(config.loop),
      speed_(config.speed),
      position_(static_cast<std::int64_t>(tape_->at(config.from))) {
    if (!config.begins) return;
    const auto* const stamp = std::get_if<std::chrono::nanoseconds>(&*config.begins);
    begins_ = stamp != nullptr ? *stamp : tape_->recorded().value();
}

Replay::Place Replay::place(sim::Time time) const {
    constexpr Scaled farthest = std::chrono::hours(24 * 365 * 100);
    // In floating point, since the difference of two stamps may not fit into a Time.
    const Scaled scaled = (Scaled(time) - Scaled(*begins_)) * speed_;
    const auto since = std::chrono::round<sim::Time>(std::clamp(scaled, -farthest, farthest));
    const sim::Time whole = tape_->begin(tape_->size());
    if (loop_ == ReplayLoop::none || since < -nearly) return {0, since};
    const std::int64_t round = (since + nearly) / whole;
    return {round, since - round * whole};
}

std::int64_t Replay::position(const ReplayTurn& turn) const {
    if (begins_) {
        const Place there = place(turn.begins);
        const bool is_over = there.at + nearly >= tape_->begin(tape_->size());
        const std::size_t scan = is_over ? tape_->size() : tape_->at(there.at + nearly);
        return there.round * static_cast<std::int64_t>(tape_->size()) +
               static_cast<std::int64_t>(scan);
    }
    return position_ + (paused_ ? std::min(turn.number, paused_from_) : turn.number) - turn_;
}

std::optional<std::size_t> Replay::scan_at(std::int64_t position) const {
    const auto scans = static_cast<std::int64_t>(tape_->size());
    if (loop_ == ReplayLoop::none && (position < 0 || position >= scans)) return std::nullopt;
    return static_cast<std::size_t>((position % scans + scans) % scans);
}

std::optional<Replay::Shown> Replay::at(const ReplayTurn& turn) const {
    if (paused_ && turn.number >= paused_from_) return std::nullopt;
    const std::int64_t there = position(turn);
    const auto scan = scan_at(there);
    if (!scan) return std::nullopt;
    if (begins_ && std::chrono::abs(place(turn.begins).at - tape_->begin(*scan)) > nearly)
        return std::nullopt;
    std::uint32_t stamp_ms = tape_->stamp_ms(*scan);
    if (loop_ == ReplayLoop::on) {
        const auto rounds = there / static_cast<std::int64_t>(tape_->size());
        const auto whole =
            std::chrono::round<std::chrono::milliseconds>(tape_->begin(tape_->size()));
        stamp_ms += static_cast<std::uint32_t>(rounds * whole.count());
    }
    return Shown{*scan, stamp_ms & stamp_mask};
}

sim::Time Replay::lasts(const ReplayTurn& turn) const {
    const auto scan = scan_at(position(turn)).value_or(tape_->size() - 1);
    sim::Time recorded = tape_->lasts(scan);
    if (begins_) {
        // To the next scan. Where that is far, turns like others pass before it.
        const sim::Time at = place(turn.begins).at;
        const sim::Time next = at < -nearly ? -at : tape_->begin(scan + 1) - at;
        const sim::Time usual = tape_->lasts(tape_->size() - 1);
        recorded = next > sim::Time::zero() && next <= 2 * usual ? next : usual;
    }
    const auto scaled = std::chrono::round<sim::Time>(Scaled(recorded) / speed_);
    return std::max(scaled, sim::Time(std::chrono::milliseconds(1)));
}

void Replay::rebase(const ReplayTurn& turn) {
    position_ = position(turn);
    begins_.reset();
    turn_ = turn.number;
    paused_from_ = turn.number;
}

ReplayStatus Replay::steer(const ReplaySteering& steering, const ReplayTurn& turn) {
    rebase(turn);
    if (steering.at) position_ = static_cast<std::int64_t>(tape_->at(*steering.at));
    if (steering.speed) speed_ = *steering.speed;
    paused_ = steering.paused.value_or(paused_);
    if (steering.step) {
        paused_ = true;
        paused_from_ = turn.number + *steering.step;
    }
    return status({.number = paused_ ? paused_from_ : turn.number, .begins = turn.begins});
}

ReplayStatus Replay::status(const ReplayTurn& turn) const {
    const auto scan = scan_at(position(turn));
    const std::size_t next = scan.value_or(tape_->size());
    return {.file = file_,
            .state = !scan                                    ? "over"
                     : paused_ && turn.number >= paused_from_ ? "paused"
                                                              : "playing",
            .speed = speed_,
            .scan = next,
            .scans = tape_->size(),
            .at = tape_->begin(next),
            .duration = tape_->begin(tape_->size())};
}

}  // namespace scipd::daemon
