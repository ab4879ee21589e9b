// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// scipctl scene map and export: the world of a running scipd as files of others.
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

#include "sim/export/floor_map.h"
#include "sim/export/gltf_file.h"
#include "sim/export/map_values.h"
#include "sim/export/ros_map_files.h"
#include "tools/control_client.h"
#include "tools/output_file.h"
#include "tools/scipctl/downloaded_world.h"
#include "tools/scipctl/scipctl_commands.h"

namespace scipd::tools {
namespace {

struct MapOptions {
    std::string file;
    std::string heights;
    std::string resolution = "0.05";
};

void write_map(const ControlOptions& control, const MapOptions& options) {
    const auto band = sim::parse_heights(options.heights);
    if (!band) throw std::runtime_error("--z " + band.error().why);
    const auto resolution_m = sim::parse_cell_size(options.resolution);
    if (!resolution_m) throw std::runtime_error("--resolution " + resolution_m.error().why);
    ControlClient client(control.socket);
    const DownloadedWorld world = download_world(client);
    sim::FloorMapOptions wanted{
        .low_m = band->low_m, .high_m = band->high_m, .resolution_m = *resolution_m};
    if (!world.robots_m.empty()) wanted.robots_m = world.robots_m;
    const auto map = sim::floor_map(world.meshes, wanted);
    if (!map) throw std::runtime_error(map.error().why);
    const auto written = sim::write_ros_map(*map, options.file);
    if (!written) throw std::runtime_error(written.error().why);
    std::cout << *written << '\n';
}

void write_glb(const ControlOptions& control, const std::string& file) {
    ControlClient client(control.socket);
    const DownloadedWorld world = download_world(client);
    write_to(file,
             [&](std::ostream& out) { out << sim::glb_of(world.meshes, world.name, world.looks); });
    std::cout << file << ": " << world.meshes.size() << " objects\n";
}

/// A check of an option: the file can be written and ends with this.
CLI::Validator file_of(const std::string& ending) {
    return CLI::Validator(
        [ending](const std::string& file) {
            if (!file.ends_with(ending)) return file + ": the name must end with " + ending;
            return can_be_written(file);
        },
        "");
}

}  // namespace

void add_scene_file_commands(CLI::App& scene, const ControlOptions& control) {
    auto* const map = scene.add_subcommand("map", "write a ROS map of the world, for AMCL");
    const auto options = std::make_shared<MapOptions>();
    map->add_option("-o,--output", options->file, "MAP.yaml; MAP.pgm is written beside it")
        ->required()
        ->check(file_of(".yaml"));
    map->add_option("--z", options->heights,
                    "the height of the scanner above z = 0 of the world in m, or LOW:HIGH")
        ->required();
    map->add_option("--resolution", options->resolution, "the side of a cell in m")
        ->capture_default_str();
    map->callback([&control, options] { write_map(control, *options); });
    map->footer(
        "Everything is where it is now, without the bodies of robots. A cell is free if a robot "
        "could\n"
        "get to its middle, occupied if a face is before it, and else unknown.\n"
        "Example: scipctl scene map -o hall.yaml --z 0.17 --resolution 0.05");

    auto* const glb = scene.add_subcommand("export", "write the world as one glTF file (GLB)");
    const auto file = std::make_shared<std::string>();
    glb->add_option("-o,--output", *file, "WORLD.glb")->required()->check(file_of(".glb"));
    glb->callback([&control, file] { write_glb(control, *file); });
    glb->footer("Everything is where it is now, without the bodies of robots.");
}

}  // namespace scipd::tools
