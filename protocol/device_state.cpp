// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/device_state.h"

#include <algorithm>
#include <utility>

namespace scipd::protocol {
namespace {

using namespace std::chrono_literals;

// UST protocol C-42-04076: the second RB must come within a second of the first. One second after
// it all communication stops.
constexpr Uptime second_reboot_within = 1s;
constexpr Uptime reboot_delay = 1s;

}  // namespace

void DeviceState::advance(Uptime now) {
    if (reboots_at_ && *reboots_at_ <= now) boot(*reboots_at_, boot_time_);
}

void DeviceState::boot(Uptime now, Uptime boot_time) {
    const StreamId last_stream = last_stream_;
    const int boots = boots_;
    const bool scip1 = powers_up_in_scip1_;
    *this = {};
    if (scip1) power_up_in_scip1(now + boot_time);
    last_stream_ = last_stream;
    boots_ = boots + 1;
    clock_zero_ = now;
    mirror_origin_ = now;
    booted_at_ = now + boot_time;
}

void DeviceState::power_up_in_scip1(Uptime now) {
    powers_up_in_scip1_ = true;
    speak_scip1();
    switch_laser_on(now);
}

bool DeviceState::ask_reboot(Uptime now, Uptime boot_time) {
    const auto first = std::exchange(reboot_asked_at_, now);
    if (!first || now - *first > second_reboot_within) return false;
    reboot_asked_at_.reset();
    reboots_at_ = now + reboot_delay;
    boot_time_ = boot_time;
    return true;
}

bool DeviceState::streams(StreamId stream) const {
    return std::find(open_streams_.begin(), open_streams_.end(), stream) != open_streams_.end();
}

void DeviceState::switch_laser_on(Uptime now) {
    if (!laser_on_) laser_on_since_ = std::max(now, motor_up_at_);
    laser_on_ = true;
}

DeviceState::StreamId DeviceState::open_stream(Uptime now) {
    switch_laser_on(now);
    open_streams_.push_back(++last_stream_);
    return last_stream_;
}

void DeviceState::close_stream(StreamId stream) {
    if (std::erase(open_streams_, stream) > 0) stop();
}

void DeviceState::stop() {
    if (open_streams_.empty()) laser_on_ = false;
}

void DeviceState::speak_scip1() {
    speaks_scip1_ = true;
}

void DeviceState::speak_scip2() {
    speaks_scip1_ = false;
    laser_on_ = false;
}

void DeviceState::enter_adjust() {
    open_streams_.clear();
    laser_on_ = false;
    adjusting_ = true;
}

void DeviceState::leave_adjust() {
    adjusting_ = false;
}

void DeviceState::sleep() {
    open_streams_.clear();
    laser_on_ = false;
    asleep_ = true;
}

void DeviceState::wake(Uptime now, Uptime wake_time) {
    if (std::exchange(asleep_, false)) motor_up_at_ = now + wake_time;
}

void DeviceState::spin_up(Uptime until) {
    motor_up_at_ = until;
    laser_on_since_ = std::max(laser_on_since_, until);
}

void DeviceState::spun_up(Uptime now) {
    motor_up_at_ = std::min(motor_up_at_, now);
    laser_on_since_ = std::min(laser_on_since_, now);
}

void DeviceState::reset(Uptime now) {
    partial_reset(now);
    settings_ = {};
}

void DeviceState::partial_reset(Uptime now) {
    open_streams_.clear();
    laser_on_ = false;
    adjusting_ = false;
    clock_zero_ = now;
    settings_.sensitive = false;
}

}  // namespace scipd::protocol
