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
            return "since the client has disconnected";
        case DeviceLog::By::last_scan:
            break;
    }
    return "since all scans that were asked for are taken";
}

const char* words(protocol::LinkKind from, Leaving why) {
    switch (why) {
        case Leaving::closed:
            return from == protocol::LinkKind::tty ? "closed the tty" : "closed the connection";
        case Leaving::cut:
            return "cut off by a fault";
        case Leaving::silent:
            return "its machine no longer answers";
        case Leaving::booted:
            return "the scanner boots";
        case Leaving::ended:
            break;
    }
    return "the scanner was changed, removed or stopped";
}

}  // namespace

DeviceLog::~DeviceLog() {
    log_suppressed();
    count(-connected_);
}

void DeviceLog::count(int more) {
    connected_ += more;
    if (clients_ != nullptr) *clients_ += more;
}

void DeviceLog::booted(bool laser_on) {
    laser_on_ = laser_on;
    log("boots");
}

void DeviceLog::laser(bool on, By by) {
    if (std::exchange(laser_on_, on) == on) return;
    log(std::string("laser ") + (on ? "on" : "off") + ", " + words(by));
}

void DeviceLog::came(const std::string& from) {
    count(1);
    log(from.empty() ? "client opened the tty" : "client connected from " + from);
}

void DeviceLog::waits(const std::string& from, const std::string& served) {
    log("client from " + from + " waits until " + served +
        " disconnects: a scanner serves one TCP client at a time");
}

void DeviceLog::left(protocol::LinkKind from, Leaving why) {
    if (connected_ > 0) count(-1);  // a tty may have been open before
    log(std::string("client disconnected (") + words(from, why) + ")");
}

// The latest of the suppressed changes may be the present state, such as a laser that is off.
void DeviceLog::log(const std::string& change) {
    if (const auto suppressed = throttle_.admit(std::chrono::steady_clock::now()))
        return spdlog::info("{}: {}{}", name_, change, *suppressed);
    latest_suppressed_ = change;
    if (!calm_) calm_ = clock_.make_idle_alarm();
    calm_->set(clock_.now() + std::chrono::seconds(1), [this] { log_suppressed(); });
}

void DeviceLog::log_suppressed() {
    const std::string count = throttle_.take_suppressed();
    if (!count.empty()) spdlog::info("{}: {}, the last: {}", name_, count, latest_suppressed_);
}

}  // namespace scipd::daemon
