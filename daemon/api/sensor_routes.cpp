// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How the daemon and its sensors are doing, what cameras and rangers measure, and what was true
// when a sensor measured.
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <variant>

#include "daemon/api/documents.h"
#include "daemon/api/errors_request.h"
#include "daemon/api/measurement_text.h"
#include "daemon/api/pose_routes.h"
#include "daemon/api/route_handlers.h"
#include "daemon/config/sensor_config.h"
#include "daemon/http/problem.h"
#include "daemon/http/url.h"

namespace scipd::daemon {
namespace {

template <class Value>
Json or_null(const std::optional<Value>& value) {
    return value ? Json(*value) : Json(nullptr);
}

double milliseconds(const std::optional<Lateness::Duration>& time) {
    return std::chrono::duration<double, std::milli>(*time).count();
}

Json to_json(const Lateness& lateness) {
    if (lateness.count() == 0) return {{"p50", nullptr}, {"p99", nullptr}, {"max", nullptr}};
    return {{"p50", milliseconds(lateness.quantile(0.5))},
            {"p99", milliseconds(lateness.quantile(0.99))},
            {"max", milliseconds(lateness.max())}};
}

/// By bounds that each have twice as much as the one before; the last count is of those beyond.
Json histogram_of(const Lateness& lateness) {
    if (lateness.count() == 0) return nullptr;
    constexpr int first_octave = 4;  // 16 us
    constexpr int last_octave = 17;
    Json bounds_ms = Json::array();
    Json counts = Json::array();
    std::uint64_t before = 0;
    for (int octave = first_octave; octave <= last_octave; ++octave) {
        const std::uint64_t below = lateness.below(octave);
        bounds_ms.push_back(std::ldexp(1e-3, octave));
        counts.push_back(below - std::exchange(before, below));
    }
    counts.push_back(lateness.count() - before);
    return {{"le_ms", bounds_ms}, {"counts", counts}};
}

Json casts_of(const SensorCounts& counts) {
    Json casts = Json::object();
    for (const auto& [backend, count] : counts.casts)
        casts[backend] = count.casts;
    return casts;
}

// One by one: of a list of members the library makes more than twice the work, and a rig has
// hundreds of sensors.
Json to_json(const SensorReport& sensor) {
    Json told = Json::object();
    told["name"] = sensor.name;
    told["model"] = sensor.model;
    told["backend"] = sensor.backend;
    told["backend_reason"] = or_null(sensor.backend_reason);
    told["errors"] = sensor.errors ? errors_document(*sensor.errors) : Json();
    told["seed"] = std::to_string(sensor.seed);
    told["state"] = sensor.state;
    told["warning"] = or_null(sensor.warning);
    told["tcp"] = or_null(sensor.tcp);
    told["pty"] = or_null(sensor.pty);
    told["clients"] = sensor.clients;
    told["connected"] = sensor.connected;
    told["waiting"] = sensor.waiting;
    told["faults"] = sensor.faults;
    told["scans"] = sensor.counts.scans;
    told["casts"] = casts_of(sensor.counts);
    told["lost"] = sensor.counts.lost;
    told["stream_lost"] = sensor.stream_lost;
    told["lateness_ms"] = to_json(sensor.counts.lateness);
    told["lateness_histogram"] = histogram_of(sensor.counts.lateness);
    return told;
}

Json to_json(const std::vector<SensorReport>& sensors) {
    Json list = Json::array();
    for (const SensorReport& sensor : sensors)
        list.push_back(to_json(sensor));
    return list;
}

Json to_json(const SharedStatus& shared) {
    return {{"broker", shared.broker},
            {"world", shared.world},
            {"name", shared.name},
            {"connected", shared.connected},
            {"daemons", shared.daemons},
            {"trouble", or_null(shared.trouble)},
            {"frames_dropped", shared.frames_dropped}};
}

Json to_json(const SourceReport& source) {
    return {{"robot", source.robot},
            {"source", source.source},
            {"type", or_null(source.type)},
            {"messages", source.messages},
            {"refused", source.refused},
            {"lost", source.lost},
            {"rate_hz", source.rate_hz},
            {"age_s", or_null(source.age_s)},
            {"late_ms", or_null(source.late_ms)},
            {"most_late_ms", or_null(source.most_late_ms)},
            {"troubles", source.troubles}};
}

Json to_json(const std::vector<SourceReport>& sources) {
    Json list = Json::array();
    for (const SourceReport& source : sources)
        list.push_back(to_json(source));
    return list;
}

Json to_json(const RigReport& rig) {
    return {{"uptime_s", rig.uptime.count()},
            {"clock", rig.clock},
            {"time_s", seconds(rig.time)},
            {"scene", rig.scene},
            {"warnings", rig.warnings},
            {"poses",
             {{"accepted", rig.poses.accepted},
              {"refused", rig.poses.refused},
              {"last_refusal", or_null(rig.poses.last_refusal)},
              {"sources", to_json(rig.poses.sources)}}},
            {"fleet", rig.fleet ? to_json(*rig.fleet) : Json()},
            {"sensors", to_json(rig.sensors)}};
}

HttpResponse no_scan_yet() {
    return problem(404,
                   "no scan yet: scipd only scans while someone reads. Run `scipcat plot "
                   "tcp://127.0.0.1:10940`, or connect a driver");
}

/// The scan of this number, from a log that holds something.
template <class Log>
HttpResponse truth_in(const Log& log, const std::string& sensor, const std::string& number) {
    std::int64_t scan = 0;
    const char* const end = number.data() + number.size();
    const auto [stop, error] = std::from_chars(number.data(), end, scan);
    if (number.empty() || error != std::errc{} || stop != end) {
        return problem(400, "scan must be the number of a scan, as /stream and /truth report it",
                       "scan");
    }
    if (const auto record = log.find(scan)) return ok_text(truth_text(sensor, *record));
    return problem(404,
                   "scan " + number + " is not kept: those from " + std::to_string(log.first()) +
                       " to " + std::to_string(log.last()) +
                       " are. For a minute from now on the truth of the last second is kept: "
                       "request a later scan",
                   "scan");
}

HttpResponse truth(Api& api, const std::string& sensor, const std::string& query,
                   const SensorRecord& latest) {
    const auto is_there = [](const auto& record) { return record != nullptr; };
    if (!std::visit(is_there, latest)) return no_scan_yet();
    if (query.empty()) {
        return ok_text(
            std::visit([&](const auto& record) { return truth_text(sensor, *record); }, latest));
    }
    const std::string number = query_value(query, "scan").value_or("");
    return std::visit([&](const auto& log) { return truth_in(log, sensor, number); },
                      api.log(sensor).value());
}

}  // namespace

std::string sensor_of(const Call& call) {
    return sensor_name(call.names[0], call.names[1]);
}

HttpResponse no_sensor(const std::string& sensor) {
    return problem(404, "there is no sensor \"" + sensor + "\"");
}

void get_status(Call&& call) {
    call.respond(ok(to_json(call.api.report())));
}

void get_sensors(Call&& call) {
    call.respond(ok(to_json(call.api.report().sensors)));
}

Json sensor_document(const Api& api, const std::string& sensor) {
    for (const SensorReport& candidate : api.report().sensors) {
        if (candidate.name == sensor) return to_json(candidate);
    }
    return {};
}

void get_sensor(Call&& call) {
    const Json document = sensor_document(call.api, sensor_of(call));
    call.respond(document.is_null() ? no_sensor(sensor_of(call)) : ok(document));
}

void patch_sensor(Call&& call) {
    const std::string sensor = sensor_of(call);
    if (!call.api.log(sensor)) return call.respond(no_sensor(sensor_of(call)));
    const auto now = call.api.errors(sensor);
    if (!now)
        return call.respond(problem(
            409,
            "\"" + sensor + "\" is a camera or a ranger, which does not change while scipd runs"));
    const auto wanted = parse_errors(call.request.body, *now);
    if (!wanted) return call.respond(bad_request(wanted.error()));
    if (const auto set = call.api.set_errors(sensor, *wanted); !set)
        return call.respond(problem(409, set.error().why, set.error().field));
    call.respond(ok(errors_document(*wanted)));
}

void get_reading(Call&& call) {
    const std::string sensor = sensor_of(call);
    const auto latest = call.api.latest(sensor);
    if (!latest) return call.respond(no_sensor(sensor_of(call)));
    if (const auto* const record = std::get_if<SharedStaringRecord>(&*latest))
        return call.respond(ok_text(reading_text(sensor, **record)));
    call.respond(problem(404, "\"" + sensor +
                                  "\" is a scanner, which its driver reads over SCIP; /sensors/" +
                                  sensor + "/truth tells what it saw"));
}

void get_truth(Call&& call) {
    const std::string sensor = sensor_of(call);
    const auto latest = call.api.latest(sensor);
    if (!latest) return call.respond(no_sensor(sensor_of(call)));
    call.api.ask_log(sensor);
    call.respond(truth(call.api, sensor, call.request.query, *latest));
}

}  // namespace scipd::daemon
