// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipctl/rates.h"

#include <algorithm>

namespace scipd::tools {
namespace {

using Json = ControlClient::Json;

/// A count that has gone back is that of another sensor of the same name.
std::optional<double> rate(const Json& before, const Json& now, double seconds) {
    if (!before.is_number() || !now.is_number() || seconds <= 0) return std::nullopt;
    const double more = now.get<double>() - before.get<double>();
    return more < 0 ? std::nullopt : std::optional(more / seconds);
}

/// Null where there is none.
Json member(const Json& object, const std::string& key) {
    return object.is_object() ? object.value(key, Json()) : Json();
}

Json sensor_of(const Json& status, const Json& name) {
    const Json sensors = status.value("sensors", Json::array());
    const auto found = std::ranges::find_if(
        sensors, [&](const Json& sensor) { return member(sensor, "name") == name; });
    return found == sensors.end() ? Json() : *found;
}

std::map<std::string, double> cast_rates(const Json& before, const Json& now, double seconds) {
    std::map<std::string, double> rates;
    const Json casts_now = member(now, "casts");
    for (const auto& [backend, count] : casts_now.items()) {
        // A backend that has just taken over had cast nothing.
        const Json earlier = member(member(before, "casts"), backend);
        const auto casts =
            rate(before.is_null() || !earlier.is_null() ? earlier : Json(0), count, seconds);
        if (casts && *casts > 0) rates[backend] = *casts;
    }
    return rates;
}

template <class Value>
Json or_null(const std::optional<Value>& value) {
    return value ? Json(*value) : Json();
}

}  // namespace

std::vector<SensorRates> rates_between(const Json& earlier, const Json& later) {
    const double seconds = later.value("uptime_s", 0.0) - earlier.value("uptime_s", 0.0);
    std::vector<SensorRates> rates;
    for (const Json& now : later.value("sensors", Json::array())) {
        const Json before = sensor_of(earlier, member(now, "name"));
        SensorRates sensor{
            .name = now.value("name", ""),
            .model = now.value("model", ""),
            .state = now.value("state", ""),
            .scans_per_s = rate(member(before, "scans"), member(now, "scans"), seconds),
            .lost = now.value("lost", std::uint64_t(0)),
            .clients = now.value("clients", std::uint64_t(0)),
            .casts_per_s = cast_rates(before, now, seconds)};
        const Json late = member(member(now, "lateness_ms"), "p99");
        if (late.is_number()) sensor.lateness_p99_ms = late.get<double>();
        rates.push_back(std::move(sensor));
    }
    return rates;
}

Json to_json(const SensorRates& sensor) {
    Json casts = Json::object();
    for (const auto& [backend, rate] : sensor.casts_per_s)
        casts[backend] = rate;
    return {{"name", sensor.name},       {"model", sensor.model},
            {"state", sensor.state},     {"scans_per_s", or_null(sensor.scans_per_s)},
            {"lost", sensor.lost},       {"lateness_p99_ms", or_null(sensor.lateness_p99_ms)},
            {"clients", sensor.clients}, {"casts_per_s", casts}};
}

}  // namespace scipd::tools
