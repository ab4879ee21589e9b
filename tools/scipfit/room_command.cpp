// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/export/map_values.h"
#include "sim/export/ros_map_files.h"
#include "tools/formatted.h"
#include "tools/options.h"
#include "tools/output_file.h"
#include "tools/scipfit/drive.h"
#include "tools/scipfit/drive_map.h"
#include "tools/scipfit/fit.h"
#include "tools/scipfit/room_report.h"
#include "tools/scipfit/scipfit_commands.h"

namespace scipd::tools {
namespace {

struct RoomOptions {
    std::filesystem::path file;
    std::string stream;
    std::string model;
    std::string output;
    std::string resolution = "0.05";
    bool json = false;
};

void tell(const auto& made, bool json) {
    std::cout << (json ? as_json(made).dump(2) + '\n' : as_text(made));
}

void make_map(const RoomOptions& options) {
    const auto resolution_m = sim::parse_cell_size(options.resolution);
    if (!resolution_m) throw WrongInput("--resolution " + resolution_m.error().why);
    const DriveMap made = map_of(read_drive(options.file, options.stream), *resolution_m);
    const auto written = sim::write_ros_map(made.map, options.output);
    if (!written) throw std::runtime_error(written.error().why);
    tell(made, options.json);
}

void make_room(const RoomOptions& options) {
    ScanTable readings;
    read_scans(*open_recorded(options.file.string()), options.file.string(),
               {.stream = options.stream, .echo = Echo::brightest}, readings);
    const Kind kind = kind_of(readings, options.model);
    if (!kind.known && !readings.identity.max_range_m)
        std::cerr << readings.files
                  << formatted(
                         ": does not say what scanner it is of: what is beyond %g m, as far as the "
                         "nearest model sees, is left out; --model names another\n",
                         kind.model->profile.dmax_mm * 1e-3);
    complete(*kind.model, readings);
    const Room room = room_of(look_at(readings));
    write_to(options.output,
             [&](std::ostream& out) { write_room(room, readings, *kind.model, out); });
    tell(room, options.json);
}

}  // namespace

void add_room_command(CLI::App& program) {
    auto* const command = program.add_subcommand(
        "room", "create a world from what a stationary or driving scanner sees");
    const auto options = std::make_shared<RoomOptions>();
    command
        ->add_option("RECORDING", options->file,
                     "of a stationary scanner; or for a map, of a drive with its poses")
        ->required();
    command
        ->add_option("-o,--output", options->output,
                     "the walls around a stationary scanner, or a ROS map of a drive; the first "
                     "scan is at the origin")
        ->required()
        ->type_name("FILE.sdf|FILE.yaml")
        ->check(can_be_written);
    command
        ->add_option("--resolution", options->resolution,
                     "the side of a map's cell in m; default: 0.05")
        ->type_name("M");
    command->add_option("--stream", options->stream,
                        "scanner to use, of a recording of several; default: the first");
    command
        ->add_option("--model", options->model,
                     "model of the scanner; default: that of the recording")
        ->type_name("MODEL");
    command->add_flag("--json", options->json, "print the quality of the fit as a JSON document");
    command->callback([options] {
        const auto ending = std::filesystem::path(options->output).extension();
        if (ending == ".yml" || ending == ".pgm")
            throw WrongInput(options->output + ": the name of a map must end with .yaml");
        ending == ".yaml" ? make_map(*options) : make_room(*options);
    });
    command->footer(
        "Examples:\n"
        "  scipfit room desk.mcap -o room.sdf\n"
        "  scipfit room carmen.log -o hall.yaml      # and hall.pgm\n"
        "  scipd --scene room.sdf --pose 0,0,0");
}

}  // namespace scipd::tools
