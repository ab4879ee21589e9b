// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Sensors that come and go while the others go on, and the models that they can be of.
#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "daemon/api/documents.h"
#include "daemon/api/errors_request.h"
#include "daemon/api/pose_routes.h"
#include "daemon/api/route_handlers.h"
#include "daemon/config/sensor_config.h"
#include "daemon/http/problem.h"
#include "daemon/models/model_list.h"
#include "daemon/models/model_registry.h"

namespace scipd::daemon {
namespace {

using Result = EditOutcome::Result;

/// "tcp: 127.0.0.1:10940 is taken" is of tcp; of no member: empty.
std::string member_of(const std::string& fault) {
    const auto colon = fault.find(": ");
    const std::string begin = fault.substr(0, colon);
    const bool is_key = colon != fault.npos && begin.find_first_of(" \"/") == begin.npos;
    return is_key ? begin : std::string{};
}

HttpResponse refused(const EditOutcome& outcome, const std::string& sensor) {
    if (outcome.result == Result::unknown) return no_sensor(sensor);
    if (outcome.result == Result::taken) return problem(409, in_one_line(outcome.messages));
    const std::vector<std::string>& faults = outcome.messages;
    if (faults.size() != 1) return problem(400, in_one_line(faults), {}, faults);
    const std::string& fault = faults.front();
    const std::string member = member_of(fault);
    return problem(400, member.empty() ? fault : fault.substr(member.size() + 2), member);
}

Json to_json(const Model& model) {
    const sim::SensorSpec& optics = model.optics;
    const protocol::DeviceProfile& profile = model.profile;
    const double period_s = std::chrono::duration<double>(profile.nominal_scan_period()).count();
    return {{"name", listed_name(model)},
            {"links", links_of(profile)},
            {"range_m", {profile.dmin_mm / 1e3, profile.dmax_mm / 1e3}},
            {"steps", optics.beams()},
            {"rate_hz", 1.0 / period_s}};
}

}  // namespace

void get_models(Call&& call) {
    Json list = Json::array();
    for (const Model& model : models())
        list.push_back(to_json(model));
    call.respond(ok(list));
}

void post_sensor(Call&& call) {
    auto wanted = parse_new_sensor(call.request.body);
    if (!wanted) return call.respond(bad_request(wanted.error()));
    if (const auto checked = check_files(*wanted); !checked)
        return call.respond(problem(403, checked.error().why, checked.error().field));
    const std::string name = sensor_name(wanted->robot, wanted->name);
    auto done = [&api = call.api, name, respond = call.respond](const EditOutcome& outcome) {
        if (outcome.result != Result::done) return respond(refused(outcome, name));
        Json document{{"warnings", outcome.messages}};
        if (!outcome.notes.empty()) document["notes"] = outcome.notes;
        document["sensor"] = sensor_document(api, name);
        respond(ok(document, 201));
    };
    call.api.add_sensor(*std::move(wanted), std::move(done), call.request.withdrawn);
}

void delete_sensor(Call&& call) {
    auto done = [name = sensor_of(call), respond = call.respond](const EditOutcome& outcome) {
        respond(outcome.result == Result::done ? no_content() : refused(outcome, name));
    };
    call.api.remove_sensor(call.names[0], call.names[1], std::move(done), call.request.withdrawn);
}

}  // namespace scipd::daemon
