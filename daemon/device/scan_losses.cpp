// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/device/scan_losses.h"

#include <utility>

namespace scipd::daemon {
namespace {

constexpr std::chrono::seconds apart(10);

std::string counted(std::uint64_t count, const std::string& things) {
    return std::to_string(count) + " " + things + (count == 1 ? "" : "s");
}

}  // namespace

std::optional<std::string> ScanLosses::add(const std::string& sensor, std::uint64_t lost,
                                           Time now) {
    sensors_.insert(sensor);
    lost_ += lost;
    if (told_ && now - *told_ < apart) return std::nullopt;
    told_ = now;
    const auto sensors = std::exchange(sensors_, {});
    const std::string who = sensors.size() == 1
                                ? sensor
                                : sensor + " and " + counted(sensors.size() - 1, "other sensor");
    return who + " lost " + counted(std::exchange(lost_, 0), "scan") +
           ": this machine is too slow for all that is to be cast, or was asleep. If it happens "
           "again: fewer sensors or beams, a lower rate, or more cores";
}

}  // namespace scipd::daemon
