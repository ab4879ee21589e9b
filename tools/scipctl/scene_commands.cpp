// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <iomanip>
#include <iostream>
#include <iterator>
#include <memory>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "tools/control_client.h"
#include "tools/options.h"
#include "tools/scipctl/model_options.h"
#include "tools/scipctl/names.h"
#include "tools/scipctl/pose_text.h"
#include "tools/scipctl/scipctl_commands.h"
#include "tools/scipctl/table.h"

namespace scipd::tools {
namespace {

namespace fs = std::filesystem;
using Json = ControlClient::Json;

struct AddOptions : ModelOptions {
    bool json = false;
};

struct LoadOptions {
    std::string file;
    bool json = false;
};

struct ListOptions {
    bool sensors = false;
    bool names = false;
    bool json = false;
};

constexpr const char* warnings_as_json = "the warnings as a JSON document on standard output";

struct MoveOptions {
    std::string name;
    std::string pose;
};

std::string text_of(const Json& pose) {
    const auto& xyz = pose.at("xyz");
    const auto& q = pose.at("q");
    return pose_text({{xyz[0], xyz[1], xyz[2]}, {q[3], q[0], q[1], q[2]}});
}

/// Prints scipd's answer after it has loaded something.
void tell(const Json& loaded, bool json) {
    if (json) {
        std::cout << json_text(loaded) << '\n';
        return;
    }
    if (!loaded.is_object()) return;
    for (const auto& warning : loaded.value("warnings", Json::array()))
        std::cerr << "warning: " << warning.get<std::string>() << '\n';
    for (const auto& note : loaded.value("notes", Json::array()))
        std::cerr << "note: " << note.get<std::string>() << '\n';
}

/// "0.1 to 30 m"
std::string span(const Json& two, double factor, const char* unit) {
    const auto text = [&](const Json& number) {
        if (number.is_null()) return std::string{"inf"};
        std::ostringstream out;
        out << std::setprecision(4) << number.get<double>() * factor;
        return out.str();
    };
    return text(two[0]) + " to " + text(two[1]) + unit;
}

void list_sensors(const Json& scene) {
    constexpr double deg_per_rad = 180.0 / std::numbers::pi;
    std::vector<Row> rows{
        {"SENSOR", "TYPE", "POSE", "RANGE", "ANGLES", "SAMPLES", "RATE", "FITS BEST"}};
    for (const Json& sensor : scene.at("sensors")) {
        const Json& rate = sensor.at("rate_hz");
        const Json& lines = sensor.at("rows");
        rows.push_back({sensor.at("name"), sensor.at("type"), text_of(sensor.at("pose")),
                        span(sensor.at("range_m"), 1.0, " m"),
                        span(sensor.at("angle_rad"), deg_per_rad, " deg"),
                        sensor.at("samples").dump() + (lines == 1 ? "" : " x " + lines.dump()),
                        rate.is_null() ? "-" : rate.dump() + " Hz", sensor.at("fits")});
    }
    print_table(std::cout, rows);
}

void list(const ControlOptions& control, const ListOptions& options) {
    ControlClient client(control.socket);
    const Json scene = client.get("/scene");
    if (options.names) {
        for (const Json& model : scene.at("models"))
            std::cout << model.at("name").get<std::string>() << '\n';
        return;
    }
    if (options.json) {
        std::cout << json_text(options.sensors ? scene.at("sensors") : scene, 2) << '\n';
        return;
    }
    std::cout << scene.value("file", "-") << "\n\n";
    if (options.sensors) return list_sensors(scene);
    std::vector<Row> rows{{"MODEL", "MOVABLE", "POSE", "OBJECTS", "MATERIALS"}};
    for (const Json& model : scene.at("models")) {
        rows.push_back({model.at("name"), model.at("movable").get<bool>() ? "yes" : "no",
                        text_of(model.at("pose")), model.at("objects").dump(),
                        joined(model.at("materials"))});
    }
    print_table(std::cout, rows);
}

void load(const ControlOptions& control, const LoadOptions& options) {
    ControlClient client(control.socket);
    tell(client.load("/scene", {{"file", fs::absolute(options.file).string()}}), options.json);
}

Json request_of(const AddOptions& options) {
    Json body{{"name", options.name}};
    if (options.file == "-") {
        body["sdf"] = std::string{std::istreambuf_iterator<char>{std::cin}, {}};
    } else {
        body["file"] = fs::absolute(options.file).string();
    }
    put_model_options(options, body);
    if (options.replace) body["replace"] = true;
    return body;
}

void add(const ControlOptions& control, const AddOptions& options) {
    const Json body = request_of(options);
    ControlClient client(control.socket);
    try {
        tell(client.post("/scene/models", body), options.json);
    } catch (const ControlError& error) {
        if (error.status() != 409) throw;
        throw ControlError(
            409, "there is a model \"" + options.name + "\": choose another name, or --replace it");
    }
}

/// Calls `change` with the model's path. If scipd does not know the model, the error lists those
/// that it knows.
template <class Change>
void change(ControlClient& client, const std::string& model, bool must_move, Change change) {
    try {
        change("/scene/models/" + path_segment(model));
    } catch (const ControlError& error) {
        if (error.status() != 404) throw;
        Json names = Json::array();
        const Json scene = client.get("/scene");
        for (const Json& known : scene.at("models")) {
            if (!must_move || known.at("movable").get<bool>()) names.push_back(known.at("name"));
        }
        const std::string kind = must_move ? "movable model" : "model";
        throw ControlError(
            404, "there is no " + kind + " \"" + model + "\"; there are: " + joined(names));
    }
}

void move(const ControlOptions& control, const MoveOptions& options) {
    const auto body = pose_body({.pose = pose_of(options.pose)});
    ControlClient client(control.socket);
    change(client, options.name, true,
           [&](const std::string& path) { client.put(path + "/pose", body); });
}

void remove(const ControlOptions& control, const std::string& name) {
    ControlClient client(control.socket);
    change(client, name, false, [&](const std::string& path) { client.remove(path); });
}

void add_list_command(CLI::App& scene, const ControlOptions& control) {
    auto* const command = scene.add_subcommand("list", "list the models of the world");
    const auto options = std::make_shared<ListOptions>();
    command->add_flag("--sensors", options->sensors,
                      "the lidars that the files of the world describe (see scipd --sensor-from), "
                      "and the model that comes closest to each");
    command->add_flag("--names", options->names, "the names of the models alone, one a line");
    command->add_flag("--json", options->json, "as a JSON document");
    command->callback([&control, options] { list(control, *options); });
}

void add_add_command(CLI::App& scene, const ControlOptions& control) {
    auto* const command = scene.add_subcommand("add", "add a model from SDF, URDF or a mesh");
    const auto options = std::make_shared<AddOptions>();
    add_model_options(*command, *options,
                      "an SDF, a URDF, a mesh or the folder of a model; - reads SDF");
    command->add_flag("--json", options->json, warnings_as_json);
    command->callback([&control, options] { add(control, *options); });
    command->footer(
        "scipd reads the file. Relative URIs in it start at its folder, as with --scene.\n"
        "With - they start at the folder of the world.\n"
        "Examples:\n"
        "  scipctl scene add crate crate.stl --scale 0.001 --material wood --pose 1,2,0\n"
        "  scipctl scene add shelf models/shelf --static");
}

void add_move_command(CLI::App& scene, const ControlOptions& control) {
    auto* const command = scene.add_subcommand("move", "set the pose of a movable model");
    const auto options = std::make_shared<MoveOptions>();
    command->add_option("MODEL", options->name, "the name of the model")->required();
    command->add_option("POSE", options->pose, "X,Y,YAW or X,Y,Z,R,P,Y in metres and radians")
        ->required();
    command->callback([&control, options] { move(control, *options); });
}

}  // namespace

void add_scene_commands(CLI::App& program, const ControlOptions& control) {
    auto* const scene = program.add_subcommand("scene", "show or change the world");
    scene->require_subcommand(1);

    add_list_command(*scene, control);

    auto* const load_command = scene->add_subcommand("load", "replace the world with another one");
    const auto options = std::make_shared<LoadOptions>();
    load_command->add_option("FILE", options->file, "a world, or the folder of a model")
        ->required()
        ->check(CLI::ExistingPath);
    load_command->add_flag("--json", options->json, warnings_as_json);
    load_command->callback([&control, options] { load(control, *options); });

    add_add_command(*scene, control);
    add_move_command(*scene, control);

    auto* const remove_command = scene->add_subcommand("remove", "remove a model");
    const auto model = std::make_shared<std::string>();
    remove_command->add_option("MODEL", *model, "the name of the model")->required();
    remove_command->callback([&control, model] { remove(control, *model); });

    add_medium_command(*scene, control);
    add_scene_file_commands(*scene, control);
}

}  // namespace scipd::tools
