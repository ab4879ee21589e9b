// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Faults on purpose: those of a scanner, and what they have done to it.
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "daemon/api/fault_text.h"
#include "daemon/api/pose_routes.h"
#include "daemon/api/route_handlers.h"
#include "daemon/faults/read_fault.h"
#include "daemon/http/problem.h"
#include "daemon/http/url.h"

namespace scipd::daemon {
namespace {

/// That wait or act at one scanner.
constexpr std::ptrdiff_t most_faults = 1000;

std::optional<std::uint64_t> whole_number(std::string_view text) {
    std::uint64_t number = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (text.empty() || error != std::errc{} || stop != end) return std::nullopt;
    return number;
}

/// Answers those who name no scanner. True: the path names one.
bool names_scanner(const Call& call) {
    const std::string sensor = sensor_of(call);
    const auto scanners = call.api.faults().scanners();
    if (std::ranges::find(scanners, sensor) != scanners.end()) return true;
    const bool there = call.api.log(sensor).has_value();
    call.respond(there ? problem(409, "\"" + sensor +
                                          "\" is a camera or ranger, which speaks no SCIP: only "
                                          "scanners have faults")
                       : no_sensor(sensor));
    return false;
}

HttpResponse no_fault(const Call& call) {
    return problem(404, "there is no fault \"" + call.names[2] + "\" at " + sensor_of(call));
}

bool is_full(const FaultsApi& faults, const std::string& scanner) {
    return std::ranges::count_if(faults.list(scanner), [](const FaultStatus& fault) {
               return fault.state != "ended";
           }) >= most_faults;
}

}  // namespace

void get_fault_kinds(Call&& call) {
    Json list = Json::array();
    for (const FaultKind* const kind : fault_kinds())
        list.push_back(kind_document(*kind));
    call.respond(ok(list));
}

void post_fault(Call&& call) {
    if (!names_scanner(call)) return;
    auto plan = parse_fault(call.request.body);
    if (!plan) return call.respond(bad_request(plan.error()));
    FaultsApi& faults = call.api.faults();
    const std::string scanner = sensor_of(call);
    if (is_full(faults, scanner)) {
        return call.respond(problem(409, std::to_string(most_faults) + " faults wait or act at " +
                                             scanner + ", and there cannot be more: stop some"));
    }
    const FaultStarted started = faults.start(scanner, *std::move(plan));
    Json document{{"id", started.id}};
    if (!started.notes.empty()) document["notes"] = started.notes;
    call.respond(ok(document, 201));
}

void get_faults(Call&& call) {
    if (!names_scanner(call)) return;
    Json list = Json::array();
    for (const FaultStatus& fault : call.api.faults().list(sensor_of(call)))
        list.push_back(fault_document(fault));
    call.respond(ok(list));
}

void delete_faults(Call&& call) {
    if (!names_scanner(call)) return;
    call.api.faults().stop_all(sensor_of(call));
    call.respond(no_content());
}

void get_fault(Call&& call) {
    if (!names_scanner(call)) return;
    const auto id = whole_number(call.names[2]);
    const auto list = call.api.faults().list(sensor_of(call));
    const auto found =
        std::ranges::find_if(list, [&](const FaultStatus& fault) { return id && fault.id == *id; });
    call.respond(found == list.end() ? no_fault(call) : ok(fault_document(*found)));
}

void delete_fault(Call&& call) {
    if (!names_scanner(call)) return;
    const auto id = whole_number(call.names[2]);
    const bool stopped = id && call.api.faults().stop(sensor_of(call), *id);
    call.respond(stopped ? no_content() : no_fault(call));
}

void get_fault_log(Call&& call) {
    if (!names_scanner(call)) return;
    std::optional<std::uint64_t> since = 0;
    if (!call.request.query.empty())
        since = whole_number(query_value(call.request.query, "since").value_or(""));
    if (!since) {
        return call.respond(
            problem(400, "since must be the number of an entry, its n in the log", "since"));
    }
    call.respond(ok(log_document(call.api.faults().log(sensor_of(call)), *since)));
}

}  // namespace scipd::daemon
