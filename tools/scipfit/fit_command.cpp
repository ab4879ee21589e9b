// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/fit_command.h"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/options.h"
#include "tools/output_file.h"
#include "tools/scipfit/fit_json.h"
#include "tools/scipfit/fit_text.h"
#include "tools/scipfit/known_length.h"
#include "tools/scipfit/profile_yaml.h"
#include "tools/scipfit/read_readings.h"
#include "tools/scipfit/report_html.h"
#include "tools/scipfit/room_report.h"
#include "tools/scipfit/room_sdf.h"

namespace scipd::tools {
namespace {

struct FitOptions {
    std::vector<std::filesystem::path> files;
    std::string stream;
    std::string model;
    std::vector<std::string> lengths;
    std::string output;
    std::string room;
    std::string report;
    bool json = false;
};

/// The profile has the light of a white wall as the room tells it.
void take_light(const Room& room, Fit& found) {
    if (!room.light) return;
    found.light.by_range = room.light->white;
    found.light.walls_told_apart = true;
}

/// The room as the profile names it: a configuration names files from where it lies.
std::string room_beside(const FitOptions& options) {
    if (options.room.empty()) return {};
    const auto folder = std::filesystem::absolute(options.output).parent_path();
    return std::filesystem::absolute(options.room).lexically_relative(folder).string();
}

void tell(const Fit& found, const std::optional<Room>& room, bool json) {
    if (!json) {
        show(found, std::cout);
        if (room) std::cout << as_text(*room);
        return;
    }
    auto document = as_json(found);
    if (room) document["room"] = as_json(*room);
    std::cout << document.dump(2, ' ', true, nlohmann::json::error_handler_t::replace) << '\n';
}

void fit(const FitOptions& options) {
    std::vector<Length> lengths;
    for (const std::string& length : options.lengths)
        lengths.push_back(parse_length_between(length));
    Readings readings = read_readings(options.files, options.stream);
    const Kind kind = kind_of(readings, options.model);
    complete(*kind.model, readings);
    const Standing standing = look_at(readings);
    Fit found = fit_scanner(standing, kind, lengths);
    std::optional<Room> room;
    if (!options.room.empty()) {
        room = room_of(standing);
        take_light(*room, found);
        write_to(options.room,
                 [&](std::ostream& out) { write_room(*room, readings, *kind.model, out); });
    }
    write_to(options.output,
             [&](std::ostream& out) { write_profile(found, room_beside(options), out); });
    write_to(options.report, [&](std::ostream& out) { out << as_html(standing, found, room); });
    tell(found, room, options.json);
}

}  // namespace

void add_fit_options(CLI::App& program) {
    const auto options = std::make_shared<FitOptions>();
    program.add_option("RECORDING", options->files,
                       "recordings of one scanner that stands still, in any format that scipcat "
                       "info knows");
    program
        .add_option("-o,--output", options->output,
                    "the profile: a configuration for scipd, with what each value is from")
        ->type_name("FILE.yaml")
        ->check(can_be_written);
    program
        .add_option("--room", options->room,
                    "also make the room, and have the profile stand in it: a twin of the scanner "
                    "where it stood")
        ->type_name("FILE.sdf")
        ->check(can_be_written);
    program
        .add_option("--report", options->report,
                    "a page with pictures: the noise beside the twin's, how good the law is, and "
                    "what is not known")
        ->type_name("FILE.html")
        ->check(can_be_written);
    program.add_option("--stream", options->stream,
                       "which scanner, of recordings of several; default: the first");
    program
        .add_option("--model", options->model,
                    "what the scanner is; default: what the recording says, or the nearest model")
        ->type_name("MODEL");
    program
        .add_option("--length", options->lengths,
                    "a length that was measured between what two steps see, such as 180:900=3.2m; "
                    "it may be given several times")
        ->type_name("STEP:STEP=METRES");
    program.add_flag("--json", options->json, "as a JSON document");
    program.callback([options, &program] {
        if (!program.get_subcommands().empty()) return;
        if (options->files.empty()) throw WrongInput("name a recording");
        fit(*options);
    });
}

}  // namespace scipd::tools
