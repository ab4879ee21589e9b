// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// scipctl fault: has something go wrong at a scanner, and tells what went wrong.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tools/control_client.h"
#include "tools/member_text.h"
#include "tools/options.h"
#include "tools/scipctl/names.h"
#include "tools/scipctl/scipctl_commands.h"
#include "tools/scipctl/table.h"

namespace scipd::tools {
namespace {

/// A fault in the words of the command line.
struct FaultWords {
    std::string kind;
    std::vector<std::string> members;  ///< KEY=VALUE: a value is YAML, and dots nest
    std::string at;                    ///< KEY=VALUE; request=MD:2
    std::string how_long;
    std::string until;
    std::string every;
    std::string jitter;
    std::string seed;
};

using Json = ControlClient::Json;

/// An option such as --at scan=12.
void add_option(Json& fault, const std::string& key, const std::string& text,
                const std::string& examples) {
    if (text.empty()) return;
    auto [name, value] = pair_of(text, examples);
    Json map = Json::object();
    const auto colon = name == "request" ? value.find(':') : std::string::npos;
    if (colon != std::string::npos) {
        map["request"] = value.substr(0, colon);
        map["nth"] = value_of(value.substr(colon + 1));
    } else {
        map[name] = name == "request" ? Json(value) : value_of(value);
    }
    fault[key] = std::move(map);
}

/// The fault as the control API takes it. Throws WrongInput.
Json fault_of(const FaultWords& words) {
    Json fault{{"kind", words.kind}};
    for (const std::string& member : words.members)
        add_member(fault, member, "ms=50 or bytes.rate=0.01");
    add_option(fault, "at", words.at, "scan=120, time_s=12.5, scans=40, s=1 or request=MD:2");
    add_option(fault, "for", words.how_long, "scans=40 or s=1");
    if (!words.until.empty()) fault["until"] = words.until;
    add_option(fault, "every", words.every, "s=10 or scans=400");
    add_option(fault, "jitter", words.jitter, "s=2 or scans=80");
    if (!words.seed.empty()) fault["seed"] = value_of(words.seed);
    return fault;
}

/// One line for people.
std::string line_of(const Json& log_entry) {
    const Json& request = log_entry.at("request");
    char place[64];
    std::snprintf(place, sizeof place, "%5llu  %10.3f s  scan %-6lld",
                  log_entry.at("n").get<unsigned long long>(), log_entry.at("time_s").get<double>(),
                  log_entry.at("scan").get<long long>());
    return place + std::string("  fault ") + log_entry.at("id").dump() + " " +
           log_entry.at("kind").get<std::string>() + ": " +
           log_entry.at("what").get<std::string>() +
           (request.is_null() ? "" : "  (" + request.get<std::string>() + ")");
}

using Json = ControlClient::Json;

struct StartOptions {
    std::string sensor;
    FaultWords fault;
    std::string json;
};

struct StopOptions {
    std::string sensor;
    std::string id = "all";
};

struct ListOptions {
    std::string sensor;  ///< empty: all of them
    bool json = false;
};

struct KindsOptions {
    bool names = false;
    bool json = false;
};

struct LogOptions {
    std::string sensor;
    std::optional<std::uint64_t> since;
    std::optional<std::uint64_t> count;
    bool follow = false;
    bool json = false;
};

std::string faults_path(const std::string& sensor) {
    return sensor_path(sensor) + "/faults";
}

Json request_of(const StartOptions& options) {
    const FaultWords& words = options.fault;
    if (options.json.empty()) {
        if (words.kind.empty())
            throw WrongInput("name a kind of fault; `scipctl fault kinds` lists them");
        return fault_of(words);
    }
    if (!words.kind.empty() || fault_of(words).size() > 1)
        throw WrongInput("--json is the whole fault: leave out the other options");
    Json fault = Json::parse(options.json, nullptr, false);
    if (!fault.is_object())
        throw WrongInput(R"(--json must be an object such as {"kind":"stall"})");
    return fault;
}

/// Where there is one scanner, its name may be left out: the first word is the kind then, and the
/// second already a member.
void leave_sensor_out(StartOptions& options) {
    FaultWords& words = options.fault;
    if (options.sensor.empty() || could_be_sensor(options.sensor)) return;
    if (!words.kind.empty()) words.members.insert(words.members.begin(), words.kind);
    words.kind = std::exchange(options.sensor, {});
}

void leave_sensor_out(StopOptions& options) {
    if (options.sensor.empty() || could_be_sensor(options.sensor)) return;
    options.id = std::exchange(options.sensor, {});
}

void start(const ControlOptions& control, const StartOptions& options) {
    const Json fault = request_of(options);
    ControlClient client(control.socket);
    const std::string sensor = choose_sensor(client, options.sensor);
    const Json started =
        about_sensor(client, sensor, [&] { return client.post(faults_path(sensor), fault); });
    for (const auto& note : started.value("notes", Json::array()))
        std::cerr << "note: " << note.get<std::string>() << '\n';
    std::cout << started.at("id") << '\n';
}

void stop(const ControlOptions& control, const StopOptions& options) {
    ControlClient client(control.socket);
    const std::string sensor = choose_sensor(client, options.sensor);
    std::string path = faults_path(sensor);
    if (options.id != "all") path += "/" + path_segment(options.id);
    about_sensor(client, sensor, [&] { client.remove(path); });
}

/// The faults of one scanner, each with its name.
Json faults_of(ControlClient& client, const std::string& sensor) {
    Json list = Json::array();
    for (const Json& fault : ask_sensor(client, sensor, faults_path(sensor))) {
        Json named{{"sensor", sensor}};
        named.update(fault);
        list.push_back(std::move(named));
    }
    return list;
}

/// Cameras and rangers have none.
Json all_faults(ControlClient& client) {
    constexpr int no_scanner = 409;
    Json all = Json::array();
    for (const Json& sensor : client.get("/sensors")) {
        try {
            for (Json& fault : faults_of(client, sensor.at("name")))
                all.push_back(std::move(fault));
        } catch (const ControlError& error) {
            if (error.status() != no_scanner) throw;
        }
    }
    return all;
}

/// What was asked for, besides the kind.
std::string rest_of(Json fault) {
    fault.erase("kind");
    return fault.empty() ? "-" : json_text(fault);
}

void list(const ControlOptions& control, const ListOptions& options) {
    ControlClient client(control.socket);
    const Json faults =
        options.sensor.empty() ? all_faults(client) : faults_of(client, options.sensor);
    if (options.json) return void(std::cout << json_text(faults, 2) << '\n');
    if (faults.empty()) return void(std::cout << "no faults are pending or active\n");
    std::vector<Row> rows{{"SENSOR", "ID", "KIND", "STATE", "HITS", "STEP", "HOW"}};
    for (const Json& fault : faults) {
        rows.push_back({fault.at("sensor"), fault.at("id").dump(), fault.at("kind"),
                        fault.at("state"), fault.at("hits").dump(),
                        number(fault.at("scenario_step"), "%.0f"), rest_of(fault.at("fault"))});
    }
    print_table(std::cout, rows);
}

void list_kinds(const ControlOptions& control, const KindsOptions& options) {
    ControlClient client(control.socket);
    const Json kinds = client.get("/faults/kinds");
    if (options.json) return void(std::cout << json_text(kinds, 2) << '\n');
    std::vector<Row> rows{{"KIND", "LAYER", "MEMBERS", "EFFECT"}};
    for (const Json& kind : kinds) {
        if (options.names) std::cout << kind.at("kind").get<std::string>() << '\n';
        rows.push_back(
            {kind.at("kind"), kind.at("layer"), joined(kind.at("members")), kind.at("summary")});
    }
    if (!options.names) print_table(std::cout, rows);
}

/// Prints the entries, at most `left` of them, and counts these down.
void print(const Json& entries, bool json, std::uint64_t& left) {
    for (const Json& entry : entries) {
        if (left == 0) return;
        --left;
        std::cout << (json ? json_text(entry) : line_of(entry)) << '\n';
    }
    std::cout.flush();
}

void show_log(const ControlOptions& control, const LogOptions& options) {
    constexpr std::chrono::milliseconds pause{200};
    ControlClient client(control.socket);
    const std::string sensor = choose_sensor(client, options.sensor);
    std::uint64_t since = options.since.value_or(0);
    std::uint64_t left = options.count.value_or(UINT64_MAX);
    while (std::cout && left > 0) {
        const Json log =
            ask_sensor(client, sensor, faults_path(sensor) + "/log?since=" + std::to_string(since));
        print(log.at("entries"), options.json, left);
        if (!options.follow) return;
        // The numbers begin again where the scanner is another one after a reload.
        since = log.at("last");
        std::this_thread::sleep_for(pause);
    }
}

void add_sensor(CLI::App& command, std::string& sensor) {
    command.add_option("SENSOR", sensor,
                       "the scanner, as ROBOT/SENSOR; not needed if there is only one");
}

void add_start_command(CLI::App& fault, const ControlOptions& control) {
    auto* const command = fault.add_subcommand("start", "start a fault; prints its id");
    const auto options = std::make_shared<StartOptions>();
    FaultWords& words = options->fault;
    add_sensor(*command, options->sensor);
    command->add_option("KIND", words.kind, "kind of fault; `scipctl fault kinds` lists them");
    command->add_option(
        "MEMBER", words.members,
        "KEY=VALUE, a parameter of the kind; dots nest, and a value is YAML or JSON");
    command->add_option("--at", words.at,
                        "start: scan=N or time_s=T (at that scan or time), scans=N or s=T (from "
                        "now), request=MD:NTH (with that request); default: now");
    command->add_option(
        "--for", words.how_long,
        "duration: scans=N or s=T; default: until it is stopped, unless the kind ends by itself");
    command->add_option("--until", words.until,
                        "ends when this command arrives (RB: when the scanner has rebooted)");
    command->add_option("--every", words.every, "period of repetition: s=T or scans=N");
    command->add_option("--jitter", words.jitter,
                        "with --every: largest random shift of a repetition, s=T or scans=N");
    command->add_option("--seed", words.seed, "seed of the fault's random numbers")->type_name("N");
    command->add_option("--json", options->json, "the whole fault as a JSON object");
    command->callback([&control, options] {
        leave_sensor_out(*options);
        start(control, *options);
    });
    command->footer(
        "Examples:\n"
        "  scipctl fault start robot/scanner stall --for s=2\n"
        "  scipctl fault start stall --for s=2\n"
        "  scipctl fault start robot/scanner corrupt bytes.rate=0.01 --at scans=40 --for scans=10\n"
        "  scipctl fault start robot/scanner dirty 'steps=[400, 500]' reads=near\n"
        "  scipctl fault start robot/scanner reboot --at request=MD:2\n"
        "  scipctl fault start robot/scanner --json '{\"kind\":\"stall\",\"for\":{\"s\":2}}'");
}

void add_stop_command(CLI::App& fault, const ControlOptions& control) {
    auto* const command = fault.add_subcommand("stop", "stop one fault of a scanner, or all");
    const auto options = std::make_shared<StopOptions>();
    add_sensor(*command, options->sensor);
    command->add_option("ID", options->id, "id of the fault, as printed by start and list, or all")
        ->capture_default_str();
    command->callback([&control, options] {
        leave_sensor_out(*options);
        stop(control, *options);
    });
}

void add_list_command(CLI::App& fault, const ControlOptions& control) {
    auto* const command =
        fault.add_subcommand("list", "list the pending, active and recently ended faults");
    const auto options = std::make_shared<ListOptions>();
    command->add_option("SENSOR", options->sensor,
                        "the scanner, as ROBOT/SENSOR; without it, all of them");
    command->add_flag("--json", options->json, "as a JSON document");
    command->callback([&control, options] { list(control, *options); });
}

void add_kinds_command(CLI::App& fault, const ControlOptions& control) {
    auto* const command = fault.add_subcommand("kinds", "list the kinds of faults");
    const auto options = std::make_shared<KindsOptions>();
    command->add_flag("--names", options->names, "the names alone, one a line");
    command->add_flag("--json", options->json, "as a JSON document");
    command->callback([&control, options] { list_kinds(control, *options); });
}

void add_log_command(CLI::App& fault, const ControlOptions& control) {
    auto* const command = fault.add_subcommand("log", "show the log of injected faults");
    const auto options = std::make_shared<LogOptions>();
    add_sensor(*command, options->sensor);
    command->add_option("--since", options->since, "only entries after the one of this number");
    command->add_option("--count", options->count, "exit after N entries");
    command->add_flag("--follow", options->follow, "keep printing new entries until interrupted");
    command->add_flag("--json", options->json, "each entry as a JSON object on a line of its own");
    command->callback([&control, options] { show_log(control, *options); });
}

}  // namespace

void add_fault_commands(CLI::App& program, const ControlOptions& control) {
    auto* const fault = program.add_subcommand("fault", "inject a fault into a scanner");
    fault->require_subcommand(1);
    add_start_command(*fault, control);
    add_stop_command(*fault, control);
    add_list_command(*fault, control);
    add_log_command(*fault, control);
    add_kinds_command(*fault, control);
}

}  // namespace scipd::tools
