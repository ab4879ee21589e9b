// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/device/scan_loop.h"

#include <algorithm>
#include <chrono>

#include <spdlog/spdlog.h>

#include "daemon/device/pace.h"

namespace scipd::daemon {
namespace {

constexpr sim::Time buffered = std::chrono::seconds(1);
/// A machine that was too slow will be again.
constexpr sim::Time overload_lasts = std::chrono::seconds(10);
/// So that those which have come to be a second late do not lose all of it at once.
constexpr std::int64_t most_at_once = 8;

/// For all loops of a thread, which lose scans together.
void tell_lost(const std::string& sensor, std::int64_t turns) {
    thread_local ScanLosses losses;
    const auto text =
        losses.add(sensor, static_cast<std::uint64_t>(turns), std::chrono::steady_clock::now());
    if (text) spdlog::warn("{}", *text);
}

}  // namespace

ScanLoop::ScanLoop(ScanSource& source, Clock& clock, std::size_t shard)
    : source_(source), clock_(clock), alarm_(clock.make_slow_alarm({.shard = shard, .may = [this] {
                                                                        return may_serve_beside();
                                                                    }})) {
    source_.on_wanted([this] { wake(); });
}

ScanLoop::~ScanLoop() {
    source_.on_wanted(nullptr);
}

void ScanLoop::wake() {
    if (waiting_) return;
    source_.resume();
    revolution_ = source_.next_revolution();
    wait(source_.leaves(revolution_));
}

void ScanLoop::wait(sim::Time until) {
    waiting_ = true;
    until_ = until;
    alarm_->set(until, [this] {
        waiting_ = false;
        serve();
    });
}

void ScanLoop::poses_came() {
    if (lacks_poses_ && source_.poses_known(revolution_)) wait(clock_.now());
}

bool ScanLoop::overdue() const {
    return waiting_ ? clock_.now() > until_ : source_.wanted();
}

void ScanLoop::serve() {
    // The motor may have been slowed down meanwhile.
    if (clock_.now() < source_.leaves(revolution_)) return wait(source_.leaves(revolution_));
    const std::int64_t lost = too_many(clock_.now() - source_.leaves(revolution_));
    if (lost > 0) give_up(lost);
    const sim::Time at_the_latest = source_.leaves(revolution_) + source_.patience();
    lacks_poses_ = clock_.now() < at_the_latest && !source_.poses_known(revolution_);
    if (lacks_poses_) return wait(at_the_latest);
    source_.turn_complete(revolution_++);
    if (source_.wanted()) wait(source_.leaves(revolution_));
}

// Where nothing is given up, which would overload the clock of all.
bool ScanLoop::may_serve_beside() const {
    return source_.stands_alone() && too_many(clock_.now() - source_.leaves(revolution_)) == 0;
}

std::int64_t ScanLoop::too_many(sim::Time late) const {
    if (late <= buffered && !clock_.overloaded()) return 0;
    const sim::Time period = source_.leaves(revolution_ + 1) - source_.leaves(revolution_);
    if (late <= source_.patience() + period) return 0;
    const std::int64_t old = source_.next_revolution() - 1 - revolution_;
    const std::int64_t too_old = old + 1 - buffered / period;
    return std::min(old, std::max(most_at_once, too_old));
}

void ScanLoop::give_up(std::int64_t turns) {
    clock_.set_overloaded_until(clock_.now() + overload_lasts);
    revolution_ += turns;
    const auto lost = static_cast<std::uint64_t>(turns);
    if (source_.driven()) missed_ += lost;
    if (source_.watched()) missed_by_watchers_ += lost;
    if (source_.wanted()) tell_lost(source_.name(), turns);
}

}  // namespace scipd::daemon
