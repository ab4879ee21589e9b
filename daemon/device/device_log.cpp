// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/device/device_log.h"

#include <chrono>

#include <spdlog/spdlog.h>

namespace scipd::daemon {
namespace {

const char* words(DeviceLog::By by) {
    switch (by) {
        case DeviceLog::By::tcp_client:
            return "by the TCP client";
        case DeviceLog::By::tty_client:
            return "by the client at the tty";
        case DeviceLog::By::fault:
            return "by a fault";
        case DeviceLog::By::leaving_client:
            return "since the client has left";
        case DeviceLog::By::last_scan:
            break;
    }
    return "since all scans that were asked for are taken";
}

}  // namespace

void DeviceLog::booted(bool laser_on) {
    laser_on_ = laser_on;
    if (const auto others = boots_.admit(std::chrono::steady_clock::now()))
        spdlog::info("{}: boots{}", name_, *others);
}

void DeviceLog::laser(bool on, By by) {
    if (std::exchange(laser_on_, on) == on) return;
    if (const auto others = switches_.admit(std::chrono::steady_clock::now()))
        spdlog::info("{}: laser {}, {}{}", name_, on ? "on" : "off", words(by), *others);
}

}  // namespace scipd::daemon
