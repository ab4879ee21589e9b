// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/reader/scene_request.h"

#include <stdexcept>
#include <string_view>
#include <vector>

#include "sim/loaders/file/between_processes.h"
#include "sim/loaders/mesh/mesh_file.h"

namespace scipd::sim {
namespace {

/// Both programs are of one build. Somebody may have replaced one of them while the other runs.
constexpr std::string_view greeting = "scipd-read " SCIPD_VERSION;

void put_path(const std::filesystem::path& path, std::FILE* out) {
    put_all(path.native(), out);
}

std::filesystem::path take_path(std::FILE* in) {
    return take_all<std::string>(in);
}

void put_model(const NewModel& model, std::FILE* out) {
    const Placement& placement = model.placement;
    put_all(placement.name, out);
    put_optional(placement.world_from_model, out);
    put_optional(placement.movable, out);
    put_all(model.text, out);
    put_path(model.folder, out);
    put_path(model.file, out);
    put_path(model.mesh, out);
    put(model.scale, out);
    put_all(model.material, out);
}

NewModel take_new_model(std::FILE* in) {
    NewModel model;
    Placement& placement = model.placement;
    placement.name = take_all<std::string>(in);
    placement.world_from_model = take_optional<Pose>(in);
    if (take_bool(in)) placement.movable = take_bool(in);
    model.text = take_all<std::string>(in);
    model.folder = take_path(in);
    model.file = take_path(in);
    model.mesh = take_path(in);
    model.scale = take<double>(in);
    model.material = take_all<std::string>(in);
    return model;
}

void put_options(const SdfOptions& sdf, const MapOptions& map, std::FILE* out) {
    put(sdf.geometry, out);
    put_each(sdf.xacro, out, [](const auto& argument, std::FILE* to) {
        put_all(argument.first, to);
        put_all(argument.second, to);
    });
    put_each(sdf.model_folders, out, put_path);
    put(sdf.most_memory_bytes, out);
    put(sdf.most_triangles, out);
    put(sdf.mesh, out);
    put(sdf.strict, out);
    put(map.bottom_m, out);
    put(map.top_m, out);
    put_all(map.material, out);
    put(map.unknown, out);
}

void take_options(SdfOptions& sdf, MapOptions& map, std::FILE* in) {
    sdf.geometry = take<SdfGeometry>(in);
    for (auto count = take<std::uint64_t>(in); count > 0; --count) {
        const auto name = take_all<std::string>(in);
        sdf.xacro[name] = take_all<std::string>(in);
    }
    sdf.model_folders = take_each<Folders>(in, take_path);
    sdf.most_memory_bytes = take<std::size_t>(in);
    sdf.most_triangles = take<std::size_t>(in);
    sdf.mesh = take<MeshLimits>(in);
    sdf.strict = take_bool(in);
    map.bottom_m = take<double>(in);
    map.top_m = take<double>(in);
    map.material = take_all<std::string>(in);
    map.unknown = take<UnknownCells>(in);
}

}  // namespace

std::string SceneRequest::name() const {
    if (const auto* world = std::get_if<World>(&wanted)) return world->string();
    return std::get<NewModel>(wanted).placement.name;
}

std::filesystem::path SceneRequest::file() const {
    if (const auto* world = std::get_if<World>(&wanted)) return *world;
    const NewModel& model = std::get<NewModel>(wanted);
    return model.mesh.empty() ? model.file : model.mesh;
}

bool SceneRequest::runs_xacro() const {
    return extension_of(file()) == ".xacro";
}

void put_request(const SceneRequest& request, std::FILE* out) {
    put_all(greeting, out);
    const auto* model = std::get_if<NewModel>(&request.wanted);
    put(model != nullptr, out);
    if (model != nullptr) {
        put_model(*model, out);
    } else {
        put_path(std::get<SceneRequest::World>(request.wanted), out);
    }
    put_options(request.sdf, request.map, out);
    put(request.most_overlap, out);
    put(request.folders.has_value(), out);
    if (request.folders) put_each(*request.folders, out, put_path);
    put(request.memory_bytes, out);
    put(request.processor_time, out);
    put(request.asked_by, out);
}

SceneRequest take_request(std::FILE* in) {
    if (take_all<std::string>(in) != greeting)
        throw std::runtime_error("scipd and scipd-read are of two versions; start scipd again");
    SceneRequest request{};
    if (take_bool(in)) {
        request.wanted = take_new_model(in);
    } else {
        request.wanted = take_path(in);
    }
    take_options(request.sdf, request.map, in);
    request.most_overlap = take<std::size_t>(in);
    if (take_bool(in)) request.folders = take_each<Folders>(in, take_path);
    request.memory_bytes = take<std::size_t>(in);
    request.processor_time = take<std::chrono::seconds>(in);
    request.asked_by = take<pid_t>(in);
    return request;
}

}  // namespace scipd::sim
