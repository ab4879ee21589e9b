// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Commands for all daemons that share a world. They go straight to its broker, so that no daemon
// need be near.
#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "daemon/fleet/pose_frame.h"
#include "tools/control_client.h"
#include "tools/options.h"
#include "tools/scipctl/broker_session.h"
#include "tools/scipctl/model_options.h"
#include "tools/scipctl/pose_text.h"
#include "tools/scipctl/scipctl_commands.h"
#include "tools/scipctl/table.h"

namespace scipd::tools {
namespace {

namespace fs = std::filesystem;
using daemon::Topic;
using Json = ControlClient::Json;

// Under this name the broker keeps where models are that these commands have moved.
constexpr const char* sender = "scipctl";

struct FleetOptions : ModelOptions {
    BrokerOptions broker;
    bool json = false;
};

/// The world of --to, or that of the daemon behind --control.
BrokerSession session_of(const ControlOptions& control, const BrokerOptions& options) {
    if (!options.to.empty()) return BrokerSession(options);
    const Json status = ControlClient(control.socket).get("/status");
    const auto fleet = status.find("fleet");
    if (fleet == status.end() || !fleet->is_object()) {
        throw ControlError(0,
                           "this scipd shares no world; name a broker and its world with --to "
                           "mqtt://HOST:PORT/WORLD");
    }
    BrokerOptions found = options;
    found.to = fleet->at("broker").get<std::string>() + "/" + fleet->at("world").get<std::string>();
    return BrokerSession(found);
}

std::string robots_of(const daemon::DaemonNote& note) {
    std::string text;
    for (const auto& [robot, body] : note.bodies)
        text += (text.empty() ? "" : ", ") + robot + (body.empty() ? "" : " (" + body + ")");
    return text.empty() ? "-" : text;
}

std::string state_of(const daemon::DaemonNote& note) {
    if (note.lost) return "lost";
    return note.trouble.empty() ? "serving" : "differs: " + note.trouble;
}

bool is_removal(const std::string& text) {
    const auto document = Json::parse(text, nullptr, false);
    return document.is_object() && document.value("remove", false);
}

Json document_of(const daemon::KeptMessages& kept) {
    Json daemons = Json::array();
    for (const auto& [name, note] : kept.daemons)
        daemons.push_back(Json::parse(text_of(note)));
    Json models = Json::object();
    for (const auto& [name, text] : kept.models)
        models[name] = Json::parse(text, nullptr, false);
    return {{"scene", kept.scene ? Json::parse(text_of(*kept.scene)) : Json()},
            {"daemons", daemons},
            {"models", models}};
}

void tell_status(const ControlOptions& control, const FleetOptions& options) {
    BrokerSession session = session_of(control, options.broker);
    const daemon::KeptMessages& kept = session.kept();
    if (options.json) {
        std::cout << json_text(document_of(kept), 2) << '\n';
        return;
    }
    std::cout << "base world " << (kept.scene ? kept.scene->hash : "-") << "\n\n";
    std::vector<Row> rows{{"DAEMON", "STATE", "HOST", "SENSORS", "ROBOTS"}};
    for (const auto& [name, note] : kept.daemons) {
        rows.push_back(
            {name, state_of(note), note.host, std::to_string(note.sensors), robots_of(note)});
    }
    print_table(std::cout, rows);
    if (kept.models.empty()) return;
    std::vector<Row> models{{"MODEL", "CHANGE"}};
    for (const auto& [name, text] : kept.models)
        models.push_back({name, is_removal(text) ? "removed" : "added"});
    std::cout << '\n';
    print_table(std::cout, models);
}

std::string text_in(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    std::istream& in = file == "-" ? std::cin : stream;
    return {std::istreambuf_iterator<char>{in}, {}};
}

// A text goes along; of a mesh only its name does.
Json body_of(const FleetOptions& options) {
    Json body{{"name", options.name}};
    const std::string kind = fs::path(options.file).extension();
    const bool is_text = options.file == "-" || kind == ".sdf" || kind == ".urdf";
    if (is_text) {
        body["sdf"] = text_in(options.file);
    } else {
        body["file"] = fs::absolute(options.file).string();
    }
    put_model_options(options, body);
    body["replace"] = true;
    return body;
}

void add(const ControlOptions& control, const FleetOptions& options) {
    const Json body = body_of(options);
    BrokerSession session = session_of(control, options.broker);
    const auto& models = session.kept().models;
    const auto known = models.find(options.name);
    if (known != models.end() && !is_removal(known->second) && !options.replace) {
        throw ControlError(
            0, "there is a model \"" + options.name + "\": choose another name, or --replace it");
    }
    session.publish(Topic::Kind::model, options.name, json_text(body));
    session.finish();
}

void remove(const ControlOptions& control, const FleetOptions& options) {
    BrokerSession session = session_of(control, options.broker);
    const bool was_added = session.kept().models.contains(options.name);
    session.publish(Topic::Kind::model, options.name, was_added ? "" : R"({"remove":true})");
    session.finish();
}

bool is_a_robot(const daemon::KeptMessages& kept, const std::string& name) {
    return std::ranges::any_of(
        kept.daemons, [&](const auto& entry) { return entry.second.bodies.contains(name); });
}

/// What was kept, with the model there now.
std::string places_with(const std::string& places, sim::PoseLine line) {
    std::string frame;
    for (const sim::PoseLine& other : daemon::poses_in(places)) {
        if (other.model != line.model) daemon::append_line(frame, other);
    }
    line.time = std::chrono::system_clock::now().time_since_epoch();
    daemon::append_line(frame, line);
    return frame;
}

void move(const ControlOptions& control, const FleetOptions& options) {
    sim::PoseLine line{.pose = pose_of(options.pose)};
    BrokerSession session = session_of(control, options.broker);
    const daemon::KeptMessages& kept = session.kept();
    const bool robot = is_a_robot(kept, options.name);
    (robot ? line.robot : line.model) = options.name;
    std::string frame = daemon::frame_head(sender);
    daemon::append_line(frame, line);
    session.publish(Topic::Kind::poses, {}, frame);
    if (!robot) {
        const auto places = kept.places.find(sender);
        session.publish(Topic::Kind::places, sender,
                        places_with(places == kept.places.end() ? "" : places->second, line));
    }
    session.finish();
}

void forget(const ControlOptions& control, const FleetOptions& options) {
    BrokerSession session = session_of(control, options.broker);
    const auto& daemons = session.kept().daemons;
    const auto known = daemons.find(options.name);
    if (known == daemons.end())
        throw ControlError(0, "no daemon is named \"" + options.name + "\"");
    if (!known->second.lost) throw ControlError(0, options.name + " is serving; end it instead");
    session.publish(Topic::Kind::daemon, options.name, "");
    session.publish(Topic::Kind::places, options.name, "");
    session.finish();
}

using Do = void (*)(const ControlOptions&, const FleetOptions&);

/// A command whose options are added next.
std::pair<CLI::App*, std::shared_ptr<FleetOptions>> add_command(CLI::App& fleet,
                                                                const ControlOptions& control,
                                                                const char* name, const char* help,
                                                                Do run) {
    auto* const command = fleet.add_subcommand(name, help);
    const auto options = std::make_shared<FleetOptions>();
    command->callback([&control, options, run] { run(control, *options); });
    add_broker_options(*command, options->broker,
                       "the world at its broker; default: that of the scipd behind --control");
    return {command, options};
}

void add_add_command(CLI::App& fleet, const ControlOptions& control) {
    const auto [command, options] =
        add_command(fleet, control, "add", "add a model in all daemons", add);
    add_model_options(
        *command, *options,
        "an SDF or a URDF, whose text goes along, or - for one; or a mesh, which lies "
        "under the same name at each daemon");
    command->footer(
        "A daemon that cannot add it says why in its log and in scipctl fleet status.\n"
        "Example:\n"
        "  scipctl fleet add crate crate.sdf --pose 1,2,0 --to mqtt://127.0.0.1:1883/hall");
}

}  // namespace

void add_fleet_commands(CLI::App& program, const ControlOptions& control) {
    auto* const fleet =
        program.add_subcommand("fleet", "show or change a world that daemons share");
    fleet->require_subcommand(1);
    const auto [status, status_options] = add_command(
        *fleet, control, "status", "list the daemons and what they changed", tell_status);
    status->add_flag("--json", status_options->json, "as a JSON document");

    add_add_command(*fleet, control);

    const auto [move_command, move_options] =
        add_command(*fleet, control, "move", "set the pose of a robot or a movable model", move);
    move_command->add_option("NAME", move_options->name, "the robot or the model")->required();
    move_command
        ->add_option("POSE", move_options->pose, "X,Y,YAW or X,Y,Z,R,P,Y in metres and radians")
        ->required();

    const auto [remove_command, remove_options] =
        add_command(*fleet, control, "remove", "remove a model from all daemons", remove);
    remove_command->add_option("MODEL", remove_options->name, "the name of the model")->required();

    const auto [forget_command, forget_options] =
        add_command(*fleet, control, "forget", "remove a lost daemon from the list", forget);
    forget_command->add_option("DAEMON", forget_options->name, "the name of the daemon")
        ->required();
}

}  // namespace scipd::tools
