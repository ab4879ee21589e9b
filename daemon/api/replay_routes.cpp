// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The recording that a scanner plays: how it stands, and what it shows next.
#include <cmath>
#include <cstdint>
#include <string>

#include "daemon/api/documents.h"
#include "daemon/api/route_handlers.h"
#include "daemon/http/problem.h"
#include "sim/loaders/poses/small_json.h"
#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

using sim::Expected;

constexpr double longest_s = 1e9;
constexpr double slowest = 0.001;
constexpr double fastest = 1000.0;

Expected<double> number_within(const nlohmann::json& value, const std::string& key, double low,
                               double high, const std::string& otherwise) {
    if (!value.is_number() || !(value >= low && value <= high))
        return sim::refuse(key, key + " must be " + otherwise);
    return value.get<double>();
}

Expected<> read_steering(const std::string& key, const nlohmann::json& value,
                         ReplaySteering& steering) {
    if (key == "at_s") {
        return number_within(value, key, 0.0, longest_s, "a time from 0 to 1e9 s")
            .map([&](double at_s) { steering.at = sim::Time(std::llround(at_s * 1e9)); });
    }
    if (key == "speed") {
        return number_within(value, key, slowest, fastest, "a factor from 0.001 to 1000")
            .map([&](double speed) { steering.speed = speed; });
    }
    if (key == "step") {
        const auto scans =
            number_within(value, key, 1.0, 1e6, "a number of scans from 1 to 1000000");
        return scans.map([&](double count) { steering.step = std::llround(count); });
    }
    if (key != "paused")
        return sim::refuse(sim::printable(key, 64),
                           "there are the keys at_s, paused, speed and step");
    if (!value.is_boolean()) return sim::refuse(key, "paused must be true or false");
    steering.paused = value.get<bool>();
    return {};
}

Expected<ReplaySteering> parse_steering(const std::string& body) {
    const auto object = sim::parse_small_json(body);
    if (!object || !object->is_object() || object->empty())
        return sim::refuse(R"(the body must be a JSON object such as {"at_s":12.5})");
    ReplaySteering steering;
    for (const auto& [key, value] : object->items()) {
        if (const auto read = read_steering(key, value, steering); !read)
            return tl::unexpected(read.error());
    }
    return steering;
}

Json replay_document(const ReplayStatus& replay) {
    return {{"file", replay.file},
            {"state", replay.state},
            {"speed", replay.speed},
            {"scan", replay.scan},
            {"scans", replay.scans},
            {"at_s", seconds(replay.at)},
            {"duration_s", seconds(replay.duration)}};
}

/// Nothing, and an answer: it plays none.
std::optional<ReplayStatus> replay_in(const Call& call) {
    const std::string sensor = sensor_of(call);
    auto replay = call.api.replay(sensor);
    if (replay) return replay;
    const bool there = call.api.log(sensor).has_value();
    call.respond(there ? problem(409, "\"" + sensor +
                                          "\" plays no recording: give it `replay` in the "
                                          "configuration, or start scipd with --replay FILE")
                       : no_sensor(sensor));
    return std::nullopt;
}

}  // namespace

void get_replay(Call&& call) {
    if (const auto replay = replay_in(call)) call.respond(ok(replay_document(*replay)));
}

void patch_replay(Call&& call) {
    if (!replay_in(call)) return;
    const auto steering = parse_steering(call.request.body);
    if (!steering) return call.respond(bad_request(steering.error()));
    call.respond(ok(replay_document(call.api.steer_replay(sensor_of(call), *steering))));
}

}  // namespace scipd::daemon
