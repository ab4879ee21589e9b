// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// scipctl scene map and export: the world of a running scipd as files of others.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iostream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>

#include "sim/export/floor_map.h"
#include "sim/export/gltf_file.h"
#include "sim/export/map_values.h"
#include "sim/export/placed_mesh.h"
#include "sim/export/ros_map_files.h"
#include "tools/control_client.h"
#include "tools/output_file.h"
#include "tools/scipctl/names.h"
#include "tools/scipctl/scipctl_commands.h"

namespace scipd::tools {
namespace {

/// The world of a running scipd, fetched as its page fetches it.
struct DownloadedWorld {
    std::string name;
    std::vector<sim::PlacedMesh> meshes;  ///< where they are now, without the bodies of robots
    std::vector<glm::dvec2> robots_m;     ///< of robots with a sensor
    std::map<std::string, sim::ExportedLook> looks;  ///< by material
};

using Json = ControlClient::Json;

/// The first four bytes of a mesh of the control API: "SCM1" (docs/api.md).
constexpr std::uint32_t magic = 0x314D4353;

[[noreturn]] void refuse_mesh(const std::string& hash) {
    throw ControlError(0, "scipd sent a mesh that is none, " + hash +
                              "; are scipctl and scipd of the same version?");
}

template <class Element>
std::vector<Element> take(const std::string& bytes, std::size_t& at, std::size_t count) {
    std::vector<Element> list(count);
    if (count > 0) std::memcpy(list.data(), bytes.data() + at, count * sizeof(Element));
    at += count * sizeof(Element);
    return list;
}

sim::SharedMesh mesh_of(const std::string& bytes, const std::string& hash) {
    constexpr std::size_t head_bytes = 12;
    if (bytes.size() < head_bytes) refuse_mesh(hash);
    std::size_t at = 0;
    const auto head = take<std::uint32_t>(bytes, at, 3);
    const std::size_t body_bytes = sizeof(glm::vec3) * head[1] + sizeof(glm::uvec3) * head[2];
    if (head[0] != magic || bytes.size() != head_bytes + body_bytes) refuse_mesh(hash);
    sim::Mesh mesh;
    mesh.vertices_m = take<glm::vec3>(bytes, at, head[1]);
    mesh.triangles = take<glm::uvec3>(bytes, at, head[2]);
    const auto is_wrong = [&](const glm::uvec3& corners) {
        return std::max({corners.x, corners.y, corners.z}) >= mesh.vertices_m.size();
    };
    if (std::ranges::any_of(mesh.triangles, is_wrong)) refuse_mesh(hash);
    return std::make_shared<const sim::Mesh>(std::move(mesh));
}

glm::dvec3 vector_of(const Json& three) {
    return {three.at(0), three.at(1), three.at(2)};
}

sim::Pose pose_in(const Json& pose) {
    const Json& q = pose.at("q");
    return {vector_of(pose.at("xyz")), {q.at(3), q.at(0), q.at(1), q.at(2)}};
}

std::vector<sim::PlacedMesh> meshes_of(const Json& objects, ControlClient& client) {
    std::vector<sim::PlacedMesh> placed;
    std::map<std::string, sim::SharedMesh> known;
    for (const Json& object : objects) {
        if (!object.at("robot").is_null()) continue;
        const std::string hash = object.at("mesh");
        sim::SharedMesh& mesh = known[hash];
        if (mesh == nullptr) mesh = mesh_of(client.text("/scene/meshes/" + hash), hash);
        placed.push_back({.name = object.at("name"),
                          .material = object.at("material"),
                          .mesh = mesh,
                          .scale = vector_of(object.at("scale")),
                          .world_from_mesh = pose_in(object.at("pose"))});
    }
    return placed;
}

/// Throws ControlError.
DownloadedWorld download_world(ControlClient& client) {
    DownloadedWorld world;
    world.name = client.get("/scene").value("name", "");
    const Json document = client.get("/scene/objects");
    world.meshes = meshes_of(document.at("objects"), client);
    for (const Json& material : document.at("materials")) {
        world.looks[material.at("name")] = {material.at("reflectivity"),
                                            material.at("transmission")};
    }
    for (const std::string& robot : robots(client)) {
        const glm::dvec3 at_m = vector_of(client.get(pose_path(robot)).at("xyz"));
        world.robots_m.emplace_back(at_m);
    }
    return world;
}

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
