// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/replay/replay.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace scipd::daemon {
namespace {

constexpr std::uint32_t stamp_mask = (1U << 24U) - 1;

}  // namespace

Replay::Replay(SharedTape tape, const ReplayConfig& config)
    : tape_(std::move(tape)),
      file_(config.file.string()),
      loop_(config.loop),
      speed_(config.speed),
      position_(static_cast<std::int64_t>(tape_->at(config.from))) {}

std::int64_t Replay::position(std::int64_t turn) const {
    return position_ + (paused_ ? std::min(turn, paused_from_) : turn) - turn_;
}

std::optional<std::size_t> Replay::scan_at(std::int64_t position) const {
    const auto scans = static_cast<std::int64_t>(tape_->size());
    if (loop_ == ReplayLoop::none && (position < 0 || position >= scans)) return std::nullopt;
    return static_cast<std::size_t>((position % scans + scans) % scans);
}

std::optional<Replay::Shown> Replay::at(std::int64_t turn) const {
    if (paused_ && turn >= paused_from_) return std::nullopt;
    const std::int64_t place = position(turn);
    const auto scan = scan_at(place);
    if (!scan) return std::nullopt;
    std::uint32_t stamp_ms = tape_->stamp_ms(*scan);
    if (loop_ == ReplayLoop::on) {
        const auto rounds = place / static_cast<std::int64_t>(tape_->size());
        const auto whole =
            std::chrono::round<std::chrono::milliseconds>(tape_->begin(tape_->size()));
        stamp_ms += static_cast<std::uint32_t>(rounds * whole.count());
    }
    return Shown{*scan, stamp_ms & stamp_mask};
}

sim::Time Replay::lasts(std::int64_t turn) const {
    const auto scan = scan_at(position(turn)).value_or(tape_->size() - 1);
    const auto scaled =
        std::chrono::duration<double, sim::Time::period>(tape_->lasts(scan)) / speed_;
    return std::max(std::chrono::round<sim::Time>(scaled), sim::Time(std::chrono::milliseconds(1)));
}

void Replay::rebase(std::int64_t turn) {
    position_ = position(turn);
    turn_ = turn;
    paused_from_ = turn;
}

void Replay::steer(const ReplaySteering& steering, std::int64_t turn) {
    rebase(turn);
    if (steering.at) position_ = static_cast<std::int64_t>(tape_->at(*steering.at));
    if (steering.speed) speed_ = *steering.speed;
    paused_ = steering.paused.value_or(paused_);
    if (!steering.step) return;
    paused_ = true;
    paused_from_ = turn + *steering.step;
}

ReplayStatus Replay::status(std::int64_t turn) const {
    const auto scan = scan_at(position(turn));
    const std::size_t next = scan.value_or(tape_->size());
    return {.file = file_,
            .state = !scan                             ? "over"
                     : paused_ && turn >= paused_from_ ? "paused"
                                                       : "playing",
            .speed = speed_,
            .scan = next,
            .scans = tape_->size(),
            .at = tape_->begin(next),
            .duration = tape_->begin(tape_->size())};
}

}  // namespace scipd::daemon
