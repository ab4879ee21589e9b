// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The next scans of a scanner as a file, in the formats of scipcat.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string>

#include "daemon/api/recordings.h"
#include "daemon/api/route_handlers.h"
#include "daemon/http/problem.h"
#include "daemon/http/url.h"
#include "sim/recording/create_recording.h"

namespace scipd::daemon {
namespace {

std::optional<std::size_t> scans_in(const std::string& text) {
    std::size_t scans = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, scans);
    if (text.empty() || error != std::errc{} || stop != end) return std::nullopt;
    if (scans == 0 || scans > Recordings::most_scans) return std::nullopt;
    return scans;
}

HttpResponse response_of(const std::string& name, const std::string& ending,
                         sim::Expected<std::string> file) {
    if (!file) return problem(409, file.error().why);
    return {.content_type = "application/octet-stream",
            .body = std::move(*file),
            .headers = {{"Content-Disposition", "attachment; filename=\"" + name + ending + '"'}}};
}

}  // namespace

void get_recording(Call&& call) {
    const std::string sensor = sensor_of(call);
    if (!call.api.log(sensor)) return call.respond(no_sensor(sensor));
    if (!call.api.errors(sensor)) {
        return call.respond(problem(409, "\"" + sensor +
                                             "\" is a camera or a ranger, of which there are no "
                                             "recordings"));
    }
    const std::string& query = call.request.query;
    const std::string ending = '.' + query_value(query, "format").value_or("mcap");
    if (!std::ranges::count(sim::recording_endings, ending))
        return call.respond(problem(400, "format must be mcap, ubh, csv or jsonl", "format"));
    const auto scans = scans_in(query_value(query, "scans").value_or("100"));
    if (!scans) return call.respond(problem(400, "scans must be a number from 1 to 4000", "scans"));
    if (!call.api.recordings().has_room()) {
        return call.respond(
            problem(409, "4 recordings are in progress; try again when one of them is done"));
    }
    Recordings::Order order{.sensor = sensor, .ending = ending, .scans = *scans};
    order.withdrawn = call.request.withdrawn;
    order.done = [respond = call.respond, ending, name = call.names[1]](auto file) {
        respond(response_of(name, ending, std::move(file)));
    };
    order.gone = [respond = call.respond, sensor] {
        respond(problem(409, "\"" + sensor + "\" was removed or changed meanwhile; try again"));
    };
    call.api.recordings().begin(std::move(order));
}

}  // namespace scipd::daemon
