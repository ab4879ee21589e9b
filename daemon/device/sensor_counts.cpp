// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/device/sensor_counts.h"

namespace scipd::daemon {

SensorCounts& SensorCounts::operator+=(const SensorCounts& other) {
    scans += other.scans;
    lost += other.lost;
    lateness += other.lateness;
    for (const auto& [backend, more] : other.casts) {
        CastCount& count = casts[backend];
        count.casts += more.casts;
        count.spent += more.spent;
    }
    add(other.refused, refused);
    sent_bytes += other.sent_bytes;
    faults += other.faults;
    return *this;
}

std::optional<std::chrono::duration<double>> mean_cast(const SensorCounts& counts) {
    CastCount all;
    for (const auto& [backend, count] : counts.casts) {
        all.casts += count.casts;
        all.spent += count.spent;
    }
    if (all.casts == 0) return std::nullopt;
    return std::chrono::duration<double>(all.spent) / static_cast<double>(all.casts);
}

void add(const protocol::StatusCounts& more, protocol::StatusCounts& counts) {
    for (const auto& [status, count] : more)
        counts[status] += count;
}

void CastWatch::stop(const std::string& backend, SensorCounts& counts) const {
    CastCount& count = counts.casts[backend];
    ++count.casts;
    count.spent += std::chrono::steady_clock::now() - begin_;
}

}  // namespace scipd::daemon
