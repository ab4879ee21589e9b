// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/device/scan_loop.h"

namespace scipd::daemon {
namespace {

// Turns that are late by less are all served, one right after the other: the kernel's buffers would
// have held them too.
constexpr sim::Time too_late = std::chrono::seconds(1);

}  // namespace

ScanLoop::ScanLoop(Device& device, Clock& clock)
    : device_(device), clock_(clock), alarm_(clock.make_alarm()) {
    device_.on_wanted([this] { wake(); });
}

ScanLoop::~ScanLoop() {
    device_.on_wanted(nullptr);
}

void ScanLoop::wake() {
    if (waiting_) return;
    revolution_ = device_.next_revolution();
    wait();
}

void ScanLoop::wait() {
    waiting_ = true;
    alarm_->set(device_.leaves(revolution_), [this] {
        waiting_ = false;
        serve();
    });
}

void ScanLoop::serve() {
    // The motor may have been slowed down meanwhile.
    if (clock_.now() < device_.leaves(revolution_)) return wait();
    if (clock_.now() - device_.leaves(revolution_) > too_late) {
        const std::int64_t next = device_.next_revolution();
        missed_ += static_cast<std::uint64_t>(next - revolution_);
        revolution_ = next;
    } else {
        device_.turn_complete(revolution_++);
    }
    if (device_.wanted()) wait();
}

}  // namespace scipd::daemon
