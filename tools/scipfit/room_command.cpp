// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/room_command.h"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tools/options.h"
#include "tools/output_file.h"
#include "tools/scipfit/formatted.h"
#include "tools/scipfit/fit.h"
#include "tools/scipfit/read_readings.h"
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

void show(const RoomOptions& options, const Room& room, std::size_t stations) {
    const RoomCheck& check = room.check;
    if (options.json) {
        std::cout << nlohmann::ordered_json{{"walls", room.walls.size()},
                                            {"beams", check.beams},
                                            {"explained", check.explained},
                                            {"rms_mm", check.rms_mm},
                                            {"worst_of_95_mm", check.worst_of_95_mm},
                                            {"stations", stations}}
                         .dump(2)
                  << '\n';
        return;
    }
    std::cout << formatted(
        "%zu walls explain %zu of %zu beams, %.1f mm around them (rms), 95 %% "
        "within %.1f mm\n",
        room.walls.size(), check.explained, check.beams, check.rms_mm, check.worst_of_95_mm);
    if (check.explained < check.beams)
        std::cout << formatted("%zu beams see what is no wall: it is left out\n",
                               check.beams - check.explained);
    if (stations > 1)
        std::cout << formatted(
            "the first of %zu places is taken, where the recording begins to "
            "stand\n",
            stations);
}

void make_room(const RoomOptions& options) {
    Readings readings = read_readings(std::vector{options.file}, options.stream);
    const Kind kind = kind_of(readings, options.model);
    complete(*kind.model, readings);
    const Standing standing = look_at(readings);
    const Room room = room_of(standing);
    write_to(options.output,
             [&](std::ostream& out) { write_room(room, readings, *kind.model, out); });
    show(options, room, standing.stations.size());
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
