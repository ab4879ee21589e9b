// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/mesh/mesh_relief.h"

#include "sim/loaders/mesh/mesh_file.h"

namespace scipd::sim {

bool can_be_relieved(const std::filesystem::path& file) {
    const auto extension = extension_of(file);
    return extension == ".dae" || extension == ".gltf" || extension == ".glb" ||
           extension == ".obj";
}

std::string relieved(const std::filesystem::path& file, std::string_view bytes) {
    const auto extension = extension_of(file);
    if (extension == ".dae") return relieved_collada(bytes);
    if (extension == ".gltf") return relieved_gltf(bytes);
    if (extension == ".glb") return relieved_glb(bytes);
    return std::string{bytes};
}

}  // namespace scipd::sim
