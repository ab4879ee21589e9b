// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/metrics_text.h"

#include <chrono>
#include <cmath>

#include "daemon/api/exposition.h"

namespace scipd::daemon {
namespace {

using Seconds = std::chrono::duration<double>;
using Type = Exposition::Type;
using Labels = Exposition::Labels;

// From 64 us, which nobody notices, to 1.05 s: scans that would be later are lost.
constexpr int first_octave = 6;
constexpr int last_octave = 20;

/// One sample for each sensor.
template <class Value>
void write_each(Exposition& text, const FleetMetrics& fleet, Value value) {
    for (const SensorMetrics& sensor : fleet.sensors)
        text.sample({{"sensor", sensor.name}}, value(sensor));
}

void write_lateness(Exposition& text, const SensorMetrics& sensor) {
    const Lateness& lateness = sensor.counts.lateness;
    for (int octave = first_octave; octave <= last_octave; ++octave) {
        const std::string bound = Exposition::number(std::exp2(octave) / 1e6);
        text.sample("_bucket", {{"sensor", sensor.name}, {"le", bound}}, lateness.below(octave));
    }
    text.sample("_bucket", {{"sensor", sensor.name}, {"le", "+Inf"}}, lateness.count());
    text.sample("_sum", {{"sensor", sensor.name}}, Seconds(lateness.sum()).count());
    text.sample("_count", {{"sensor", sensor.name}}, lateness.count());
}

/// One sample for each backend of each sensor.
template <class Value>
void write_casts(Exposition& text, const FleetMetrics& fleet, Value value) {
    for (const SensorMetrics& sensor : fleet.sensors) {
        for (const auto& [backend, count] : sensor.counts.casts)
            text.sample({{"sensor", sensor.name}, {"backend", backend}}, value(count));
    }
}

void write_scans(Exposition& text, const FleetMetrics& fleet) {
    text.metric("scipd_scans_total", Type::counter,
                "Scans that left when their turn was complete.");
    write_each(text, fleet, [](const auto& sensor) { return sensor.counts.scans; });
    text.metric("scipd_scans_lost_total", Type::counter,
                "Scans that a driver wanted and did not get.");
    write_each(text, fleet, [](const auto& sensor) { return sensor.counts.lost; });
    text.metric("scipd_lateness_seconds", Type::histogram,
                "How long after their ideal instant scans left.");
    for (const SensorMetrics& sensor : fleet.sensors)
        write_lateness(text, sensor);
    text.metric("scipd_casts_total", Type::counter, "Sweeps that were cast into the world.");
    write_casts(text, fleet, [](const CastCount& count) { return count.casts; });
    text.metric("scipd_cast_seconds_total", Type::counter, "Time spent on casting them.");
    write_casts(text, fleet, [](const CastCount& count) { return Seconds(count.spent).count(); });
}

void write_links(Exposition& text, const FleetMetrics& fleet) {
    text.metric("scipd_clients", Type::gauge, "Drivers that are connected by TCP or tty.");
    write_each(text, fleet, [](const auto& sensor) { return sensor.clients; });
    text.metric("scipd_sent_bytes_total", Type::counter, "Bytes sent to drivers.");
    write_each(text, fleet, [](const auto& sensor) { return sensor.counts.sent_bytes; });
    text.metric("scipd_refused_requests_total", Type::counter,
                "Requests of drivers that were answered with another status than 00.");
    for (const SensorMetrics& sensor : fleet.sensors) {
        for (const auto& [status, count] : sensor.counts.refused)
            text.sample({{"sensor", sensor.name}, {"status", status}}, count);
    }
    text.metric("scipd_faults_injected_total", Type::counter,
                "How often faults on purpose have acted.");
    write_each(text, fleet, [](const auto& sensor) { return sensor.counts.faults; });
}

void write_daemon(Exposition& text, const FleetMetrics& fleet) {
    text.metric("scipd_poses_total", Type::counter, "Poses that were taken.");
    text.sample({}, fleet.poses);
    text.metric("scipd_poses_refused_total", Type::counter, "Poses that were refused.");
    text.sample({}, fleet.poses_refused);
    text.metric("scipd_limited_total", Type::counter,
                "What was refused since it was more than a limit allows.");
    for (const auto& [limit, count] : fleet.limited)
        text.sample({{"limit", limit}}, count);
    text.metric("scipd_build_info", Type::gauge, "Always 1; the label tells the version.");
    text.sample({{"version", SCIPD_VERSION}}, std::uint64_t(1));
}

}  // namespace

std::string metrics_text(const FleetMetrics& fleet) {
    Exposition text;
    write_scans(text, fleet);
    write_links(text, fleet);
    write_daemon(text, fleet);
    return text.finish();
}

}  // namespace scipd::daemon
