// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/device/scan_loop.h"

namespace scipd::daemon {
namespace {

// All turns that are late by less are served, one right after the other: with a real scanner the
// kernel's buffers would have held them.
constexpr sim::Time too_late = std::chrono::seconds(1);

}  // namespace

ScanLoop::ScanLoop(ScanSource& source, Clock& clock)
    : source_(source), clock_(clock), alarm_(clock.make_alarm()) {
    source_.on_wanted([this] { wake(); });
}

ScanLoop::~ScanLoop() {
    source_.on_wanted(nullptr);
}

void ScanLoop::wake() {
    if (waiting_) return;
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
    const sim::Time leaves = source_.leaves(revolution_);
    // The motor may have been slowed down meanwhile.
    if (clock_.now() < leaves) return wait(leaves);
    const sim::Time at_the_latest = leaves + source_.patience();
    lacks_poses_ = clock_.now() < at_the_latest && !source_.poses_known(revolution_);
    if (lacks_poses_) return wait(at_the_latest);
    if (clock_.now() - leaves > too_late) {
        const std::int64_t next = source_.next_revolution();
        const auto passed = static_cast<std::uint64_t>(next - revolution_);
        if (source_.driven()) missed_ += passed;
        if (source_.watched()) missed_by_watchers_ += passed;
        revolution_ = next;
    } else {
        source_.turn_complete(revolution_++);
    }
    if (source_.wanted()) wait(source_.leaves(revolution_));
}

}  // namespace scipd::daemon
