// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/device/scan_loop.h"

namespace scipd::daemon {
namespace {

// Turns that are late by less are all served, one right after the other: the kernel's buffers would
// have held them too.
constexpr sim::Time too_late = std::chrono::seconds(1);

}  // namespace

ScanLoop::ScanLoop(const boost::asio::any_io_executor& executor, Device& device, const Clock& clock)
    : device_(device), clock_(clock), timer_(executor) {}

void ScanLoop::start() {
    device_.on_wanted([self = weak_from_this()] {
        if (const auto loop = self.lock()) loop->wake();
    });
}

void ScanLoop::stop() {
    stopped_ = true;
    timer_.cancel();
}

void ScanLoop::wake() {
    if (waiting_ || stopped_) return;
    revolution_ = device_.next_revolution();
    wait();
}

void ScanLoop::wait() {
    waiting_ = true;
    timer_.expires_at(clock_.when(device_.leaves(revolution_)));
    timer_.async_wait([self = shared_from_this()](const boost::system::error_code& error) {
        self->waiting_ = false;
        if (!error && !self->stopped_) self->serve();
    });
}

void ScanLoop::serve() {
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
