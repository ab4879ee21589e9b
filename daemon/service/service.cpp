// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/service/service.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <spdlog/spdlog.h>

#include "daemon/service/service_notify.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

/// How old a status may be.
constexpr std::chrono::nanoseconds status_age = 5s;

std::optional<std::chrono::nanoseconds> hunger() {
    return service_notify::watchdog();
}

}  // namespace

// A loop gets half of the watchdog's time, so that it is stuck for that time and a half at most
// when systemd acts; looks are often enough that one which comes late does no harm.
Service::Service(const boost::asio::any_io_executor& executor, Served served)
    : served_(std::move(served)),
      pause_(std::min(status_age, hunger().value_or(status_age) / 4)),
      timer_(executor) {
    if (const auto time = hunger()) watch_.emplace(*time / 2);
}

void Service::ready() {
    told_ = status();
    service_notify::ready(told_);
    go_on();
}

void Service::reloading(const std::string& file) {
    reloading_ = true;
    service_notify::reloading("reads " + file + " again");
}

void Service::reloaded(const std::string& fault) {
    reloading_ = false;
    fault_ = fault.substr(0, fault.find('\n'));
    told_ = status();
    service_notify::ready(told_);
}

void Service::stopping() {
    stopping_ = true;
    timer_.cancel();
    service_notify::stopping();
}

std::string Service::status() const {
    const std::string line = served_.status();
    return fault_.empty() ? line : line + "; the last reload changed nothing: " + fault_;
}

void Service::go_on() {
    if (!watch_ && !service_notify::is_heard()) return;
    service_notify::tell_again();
    feed();
    timer_.expires_after(pause_);
    timer_.async_wait([this](const boost::system::error_code& error) {
        if (error || stopping_) return;
        tell_changes();
        go_on();
    });
}

// Such as another world, by the control API.
void Service::tell_changes() {
    if (reloading_) return;
    std::string now = status();
    if (now == told_) return;
    service_notify::status(now);
    told_ = std::move(now);
}

void Service::feed() {
    if (!watch_) return;
    const std::vector<ScanWatch::Look> loops = served_.loops();
    const auto stuck = watch_->stuck(loops, std::chrono::steady_clock::now().time_since_epoch());
    if (stuck.empty()) service_notify::feed_watchdog();
    for (const std::string& sensor : stuck) {
        if (std::ranges::find(stuck_, sensor) != stuck_.end()) continue;
        spdlog::error("{}: its scan loop is stuck; systemd's watchdog gets nothing more", sensor);
    }
    stuck_ = stuck;
}

}  // namespace scipd::daemon
