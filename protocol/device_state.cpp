// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/device_state.h"

#include <algorithm>

namespace scipd::protocol {

bool DeviceState::streams(StreamId stream) const {
    return std::find(open_streams_.begin(), open_streams_.end(), stream) != open_streams_.end();
}

void DeviceState::switch_laser_on(Uptime now) {
    if (!laser_on_) laser_on_since_ = now;
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

void DeviceState::enter_adjust() {
    open_streams_.clear();
    laser_on_ = false;
    adjusting_ = true;
}

void DeviceState::leave_adjust() {
    adjusting_ = false;
}

void DeviceState::reset(Uptime now) {
    open_streams_.clear();
    laser_on_ = false;
    adjusting_ = false;
    clock_zero_ = now;
}

}  // namespace scipd::protocol
