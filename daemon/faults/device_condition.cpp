// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/faults/device_condition.h"

#include <utility>

#include "daemon/device/device.h"

namespace scipd::daemon {

using protocol::DeviceState;
using protocol::Trouble;
using protocol::Uptime;

void FaultedDevice::set(const DeviceCondition& condition) {
    if (condition == condition_) return;
    const DeviceCondition before = std::exchange(condition_, condition);
    device_.change([&](DeviceState& state, Uptime now) {
        if (condition.asleep && !before.asleep) slept_ = state.asleep();
        // What a client has provoked since then (DB) is not for a fault to heal.
        if (state.trouble() == before.trouble) state.set_trouble(condition.trouble);
        state.set_motor_error(condition.motor_error);
        if (before.spins_up_until && !condition.spins_up_until) state.spun_up(now);
        if (before.asleep && !condition.asleep && !slept_)
            state.wake(now, device_.profile().wake_time);
        if (condition.asleep && !before.asleep) state.sleep();
        if (condition.spins_up_until != before.spins_up_until && condition.spins_up_until)
            state.spin_up(*condition.spins_up_until);
    });
}

// A zero that is another than was set here has been set by RS or a boot: the clock goes wrong from
// there on.
void FaultedDevice::shift_clock(std::optional<Uptime> shift) {
    if (!shift && !clock_zero_) return;
    const Uptime zero = device_.state().clock_zero();
    if (!clock_zero_ || zero != clock_zero_->set) clock_zero_ = Zero{.right = zero};
    clock_zero_->set = clock_zero_->right + shift.value_or(Uptime::zero());
    device_.amend(
        [&](DeviceState& state, Uptime) { state.set_clock(clock_zero_->set, Uptime::zero()); });
    if (!shift) clock_zero_.reset();
}

void FaultedDevice::booted() {
    slept_ = false;
    device_.amend([&](DeviceState& state, Uptime) {
        if (condition_.trouble != Trouble::none) state.set_trouble(condition_.trouble);
        state.set_motor_error(condition_.motor_error);
        if (condition_.asleep) state.sleep();
        if (condition_.spins_up_until) state.spin_up(*condition_.spins_up_until);
    });
}

}  // namespace scipd::daemon
