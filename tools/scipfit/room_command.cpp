// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/room_command.h"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "tools/options.h"
#include "tools/output_file.h"
#include "tools/scipfit/fit.h"
#include "tools/scipfit/read_readings.h"
#include "tools/scipfit/room_report.h"
#include "tools/scipfit/room_sdf.h"

namespace scipd::tools {
namespace {

struct RoomOptions {
    std::filesystem::path file;
    std::string stream;
    std::string model;
    std::string output;
    bool json = false;
};

void make_room(const RoomOptions& options) {
    Readings readings = read_readings(std::vector{options.file}, options.stream);
    const Kind kind = kind_of(readings, options.model);
    complete(*kind.model, readings);
    const Room room = room_of(look_at(readings));
    write_to(options.output,
             [&](std::ostream& out) { write_room(room, readings, *kind.model, out); });
    std::cout << (options.json ? as_json(room).dump(2) + '\n' : as_text(room));
}

}  // namespace

void add_room_command(CLI::App& program) {
    auto* const command =
        program.add_subcommand("room", "make a world of the walls around a standing scanner");
    const auto options = std::make_shared<RoomOptions>();
    command->add_option("RECORDING", options->file, "a recording of a scanner that stands still")
        ->required();
    command->add_option("-o,--output", options->output, "the world; the scanner is its origin")
        ->required()
        ->type_name("FILE.sdf")
        ->check(can_be_written);
    command->add_option("--stream", options->stream,
                        "which scanner, of a recording of several; default: the first");
    command
        ->add_option("--model", options->model,
                     "what the scanner is; default: what the recording says")
        ->type_name("MODEL");
    command->add_flag("--json", options->json, "tell how well it fits as a JSON document");
    command->callback([options] { make_room(*options); });
    command->footer(
        "Example:\n"
        "  scipfit room desk.mcap -o room.sdf\n"
        "  scipd --scene room.sdf --pose 0,0,0");
}

}  // namespace scipd::tools
