// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/metrics_text.h"

#include <chrono>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <prometheus/text_serializer.h>

namespace scipd::daemon {
namespace {

using prometheus::ClientMetric;
using prometheus::MetricFamily;
using prometheus::MetricType;
using Families = std::vector<MetricFamily>;
using Labels = std::vector<ClientMetric::Label>;
using Seconds = std::chrono::duration<double>;

// From 64 us, which nobody notices, to 1.05 s: scans that would be later are lost.
constexpr int first_octave = 6;
constexpr int last_octave = 20;

void add_counter(MetricFamily& family, Labels labels, double value) {
    family.metric.push_back({.label = std::move(labels), .counter = {value}});
}

void add_gauge(MetricFamily& family, Labels labels, double value) {
    family.metric.push_back({.label = std::move(labels), .gauge = {value}});
}

/// One sensor, and those of the same name before it.
struct Counted {
    std::string name;
    std::uint64_t clients = 0;
    SensorCounts counts;
};
using AllCounted = std::vector<Counted>;

AllCounted counted(const RigReport& rig) {
    AllCounted all;
    for (const SensorReport& sensor : rig.sensors) {
        Counted& one = all.emplace_back(Counted{sensor.name, sensor.clients, sensor.counts_before});
        one.counts += sensor.counts;
        // Whoever computes a rate needs the count before the first cast.
        one.counts.casts.try_emplace(sensor.backend);
    }
    return all;
}

/// A counter for each sensor.
template <class Count>
MetricFamily of_each(const AllCounted& sensors, const char* name, const char* help, Count count) {
    MetricFamily family{name, help, MetricType::Counter, {}};
    for (const Counted& sensor : sensors)
        add_counter(family, {{"sensor", sensor.name}}, static_cast<double>(count(sensor)));
    return family;
}

/// A counter for each entry of one of the maps of each sensor. Its key becomes this label.
template <class Map, class Count>
MetricFamily of_entries(const AllCounted& sensors, const char* name, const char* help,
                        const char* label, Map map, Count count) {
    MetricFamily family{name, help, MetricType::Counter, {}};
    for (const Counted& sensor : sensors) {
        for (const auto& [key, entry] : sensor.counts.*map) {
            add_counter(family, {{"sensor", sensor.name}, {label, key}},
                        static_cast<double>(count(entry)));
        }
    }
    return family;
}

MetricFamily of_daemon(const char* name, const char* help, std::uint64_t count) {
    MetricFamily family{name, help, MetricType::Counter, {}};
    add_counter(family, {}, static_cast<double>(count));
    return family;
}

// The library adds the bucket of all, le="+Inf".
ClientMetric::Histogram histogram(const Lateness& lateness) {
    ClientMetric::Histogram told{lateness.count(), Seconds(lateness.sum()).count(), {}};
    for (int octave = first_octave; octave <= last_octave; ++octave)
        told.bucket.push_back({lateness.below(octave), std::exp2(octave) / 1e6});
    return told;
}

MetricFamily of_lateness(const AllCounted& sensors) {
    MetricFamily family{"scipd_lateness_seconds",
                        "Lateness of scans after their ideal instant.",
                        MetricType::Histogram,
                        {}};
    for (const Counted& sensor : sensors) {
        family.metric.push_back(
            {.label = {{"sensor", sensor.name}}, .histogram = histogram(sensor.counts.lateness)});
    }
    return family;
}

MetricFamily of_clients(const AllCounted& sensors) {
    MetricFamily family{
        "scipd_clients", "Drivers that are connected by TCP or tty.", MetricType::Gauge, {}};
    for (const Counted& sensor : sensors)
        add_gauge(family, {{"sensor", sensor.name}}, static_cast<double>(sensor.clients));
    return family;
}

MetricFamily of_limits(const RigReport& rig) {
    MetricFamily family{"scipd_limited_total",
                        "What was refused since it was more than a limit allows.",
                        MetricType::Counter,
                        {}};
    for (const auto& [limit, count] : rig.limited)
        add_counter(family, {{"limit", limit}}, static_cast<double>(count));
    return family;
}

MetricFamily of_build() {
    MetricFamily family{
        "scipd_build_info", "Always 1; the label holds the version.", MetricType::Gauge, {}};
    add_gauge(family, {{"version", SCIPD_VERSION}}, 1);
    return family;
}

Families of_scans(const AllCounted& sensors) {
    return {
        of_each(sensors, "scipd_scans_total", "Scans sent when their revolution was complete.",
                [](const auto& sensor) { return sensor.counts.scans; }),
        of_each(sensors, "scipd_scans_lost_total", "Scans that a driver wanted and did not get.",
                [](const auto& sensor) { return sensor.counts.lost; }),
        of_lateness(sensors),
        of_entries(sensors, "scipd_casts_total", "Sweeps that were cast into the world.", "backend",
                   &SensorCounts::casts, [](const CastCount& count) { return count.casts; }),
        of_entries(sensors, "scipd_cast_seconds_total", "Time spent on casting them.", "backend",
                   &SensorCounts::casts,
                   [](const CastCount& count) { return Seconds(count.spent).count(); })};
}

Families of_links(const AllCounted& sensors) {
    return {
        of_clients(sensors),
        of_each(sensors, "scipd_sent_bytes_total", "Bytes sent to drivers.",
                [](const auto& sensor) { return sensor.counts.sent_bytes; }),
        of_entries(sensors, "scipd_refused_requests_total",
                   "Requests of drivers that were answered with another status than 00.", "status",
                   &SensorCounts::refused, std::identity()),
        of_each(sensors, "scipd_faults_injected_total", "How often faults on purpose have acted.",
                [](const auto& sensor) { return sensor.counts.faults; })};
}

Families of_whole(const RigReport& rig) {
    return {of_daemon("scipd_poses_total", "Poses that were taken.", rig.poses.accepted),
            of_daemon("scipd_poses_refused_total", "Poses that were refused.", rig.poses.refused),
            of_limits(rig), of_build()};
}

}  // namespace

std::string metrics_text(const RigReport& rig) {
    const AllCounted sensors = counted(rig);
    Families families = of_scans(sensors);
    for (const Families& more : {of_links(sensors), of_whole(rig)})
        families.insert(families.end(), more.begin(), more.end());
    return prometheus::TextSerializer().Serialize(families);
}

}  // namespace scipd::daemon
