// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reduces mesh files to what a ray can hit. Assimp refuses a whole file for a fault in an
// animation, a skin, a camera, a texture or normals, and may then read the reduced form. Most files
// do not need it. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace scipd::sim {

/// Whether a file with this extension has a reduced form.
bool can_be_relieved(const std::filesystem::path& file);

/// The bytes that Assimp reads in place of the file's own. An OBJ stays as it is: the fault can
/// only be in the files that it names (MeshFolder). Throws std::runtime_error if the file is not of
/// the format of its extension.
std::string relieved(const std::filesystem::path& file, std::string_view bytes);

// Each format has a source file of its own.

/// A COLLADA without animations, skins, cameras, lights and pictures. Of its vertices only the
/// positions stay; a mesh with a skin stands as it does without the skin. Polygons with holes
/// become triangles, and counts are corrected. Throws std::runtime_error if the text is no COLLADA.
std::string relieved_collada(std::string_view text);

/// A glTF without animations, skins, cameras and pictures. Of its vertices only the positions stay,
/// of its materials only the names. Throws std::runtime_error if the text is no glTF.
std::string relieved_gltf(std::string_view text);

/// Relieves a GLB, whose buffer stays as it is.
std::string relieved_glb(std::string_view bytes);

}  // namespace scipd::sim
