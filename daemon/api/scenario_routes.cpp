// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Scenarios: many faults on purpose from one file.
#include <string>
#include <utility>

#include "daemon/api/fault_text.h"
#include "daemon/api/pose_routes.h"
#include "daemon/api/route_handlers.h"
#include "daemon/http/problem.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/poses/small_json.h"
#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

constexpr std::size_t longest_file_name = 255;

struct ScenarioRequest {
    std::string name;
    std::string yaml;
};

sim::Expected<ScenarioRequest> parse_request(const std::string& body) {
    const auto object = sim::parse_small_json(body);
    if (!object) return sim::refuse("the body must be JSON: " + object.error().why);
    if (!object->is_object())
        return sim::refuse(R"(the body must be an object such as {"name":"a.yaml","yaml":".."})");
    ScenarioRequest request;
    for (const auto& [key, value] : object->items()) {
        if (key != "name" && key != "yaml")
            return sim::refuse(sim::printable(key, 64), "there are the keys name and yaml");
        if (!value.is_string()) return sim::refuse(key, key + " must be a text");
        (key == "name" ? request.name : request.yaml) = value;
    }
    if (request.name.empty() || request.name.size() > longest_file_name)
        return sim::refuse("name", "name must be the name of the file, for messages");
    if (!object->contains("yaml")) return sim::refuse("yaml", "yaml must be the text of the file");
    return request;
}

HttpResponse refused(const std::string& name, const sim::LoadError& error) {
    return problem(400, sim::printable(name) + " is not a scenario that can run", "yaml",
                   error.faults());
}

}  // namespace

void put_scenario(Call&& call) {
    const auto request = parse_request(call.request.body);
    if (!request) return call.respond(bad_request(request.error()));
    FaultsApi& faults = call.api.faults();
    try {
        faults.run(parse_scenario(request->yaml, request->name, faults.scanners()));
    } catch (const sim::LoadError& error) {
        return call.respond(refused(request->name, error));
    }
    call.respond(ok(scenario_document(faults.scenario().value())));
}

void get_scenario(Call&& call) {
    const auto scenario = call.api.faults().scenario();
    call.respond(scenario ? ok(scenario_document(*scenario))
                          : problem(404, "no scenario was run: PUT one"));
}

void delete_scenario(Call&& call) {
    call.api.faults().stop_scenario();
    call.respond(no_content());
}

}  // namespace scipd::daemon
