// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/service_notify.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <ctime>

#include <systemd/sd-daemon.h>

#include "sim/text/quote.h"

namespace scipd::daemon::service_notify {
namespace {

constexpr int keep_environment = 0;
/// systemd passes over a message of more than 4096 bytes.
constexpr std::size_t longest_status = 2048;

void tell(const std::string& assignments) {
    ::sd_notify(keep_environment, assignments.c_str());
}

/// A line end would begin another assignment.
std::string status_line(const std::string& text) {
    std::string line = "STATUS=" + sim::shown(text);
    line.resize(sim::whole_characters(line, longest_status));
    std::ranges::replace(line, '\n', ' ');
    return line;
}

/// On the clock by which systemd tells this reload from an earlier one.
std::int64_t monotonic_us() {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return std::int64_t{now.tv_sec} * 1'000'000 + now.tv_nsec / 1000;
}

}  // namespace

bool is_heard() {
    return std::getenv("NOTIFY_SOCKET") != nullptr;
}

void status(const std::string& text) {
    tell(status_line(text));
}

void ready(const std::string& status) {
    tell("READY=1\n" + status_line(status));
}

void reloading(const std::string& status) {
    tell("RELOADING=1\nMONOTONIC_USEC=" + std::to_string(monotonic_us()) + "\n" +
         status_line(status));
}

void stopping() {
    tell("STOPPING=1\n" + status_line("ends"));
}

std::optional<std::chrono::microseconds> watchdog() {
    std::uint64_t interval_us = 0;
    if (::sd_watchdog_enabled(keep_environment, &interval_us) <= 0) return std::nullopt;
    return std::chrono::microseconds(interval_us);
}

void feed_watchdog() {
    tell("WATCHDOG=1");
}

}  // namespace scipd::daemon::service_notify
