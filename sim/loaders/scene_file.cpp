// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/scene_file.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "sim/loaders/file/load_error.h"
#include "sim/loaders/materials/materials_file.h"
#include "sim/loaders/reader/reader_program.h"

namespace scipd::sim {
namespace {

LoadedScene read(decltype(SceneRequest::wanted) wanted, const SceneOptions& options) {
    SceneRequest request{.wanted = std::move(wanted),
                         .sdf = options.sdf,
                         .map = options.map,
                         .most_overlap = options.most_overlap};
    return read_by(reader_program(), std::move(request), options.limits);
}

}  // namespace

LoadedScene load_scene(const std::filesystem::path& file, const SceneOptions& options) {
    LoadedScene loaded = read(file, options);
    check_materials(loaded, file.string(), options);
    return loaded;
}

LoadedScene load_model(const NewModel& model, const SceneOptions& options) {
    LoadedScene loaded = read(model, options);
    const auto& file = model.mesh.empty() ? model.file : model.mesh;
    check_materials(loaded, model.text.empty() ? file.string() : model.placement.name, options);
    return loaded;
}

void check_materials(LoadedScene& loaded, const std::string& source, const SceneOptions& options) {
    bool is_fault = !loaded.warnings.empty();
    if (options.materials) {
        is_fault = is_fault || names_unknown(*loaded.scene, *options.materials);
        std::ranges::move(unknown_materials(*loaded.scene, *options.materials, source),
                          std::back_inserter(loaded.warnings));
    }
    if (options.sdf.strict && is_fault) throw LoadError(loaded.warnings);
}

std::filesystem::path folder_of_scene(const std::filesystem::path& file) {
    std::error_code error;
    return std::filesystem::is_directory(file, error) ? file : file.parent_path();
}

}  // namespace scipd::sim
