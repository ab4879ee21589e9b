// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Mesh files without what is nothing to a ray, for when Assimp refuses a whole file for its
// animation, its skin, its cameras, textures or normals. Not for every file: most need none of
// this. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace scipd::sim {

/// Whether there is such a form of files of this name.
bool can_be_relieved(const std::filesystem::path& file);

/// What Assimp is to read in place of the file's own bytes. An OBJ stays, since what it names
/// beside itself is what can be wrong. Throws std::runtime_error where the file is no such thing.
std::string relieved(const std::filesystem::path& file, std::string_view bytes);

// Each format has a source of its own.

/// A COLLADA without animations, skins, cameras, lights, pictures, and all of its vertices but
/// where they are; what a skin covers stands in its first pose. Polygons with holes are triangles,
/// and counts are right. Throws std::runtime_error where it is none.
std::string relieved_collada(std::string_view text);

/// A glTF without animations, skins, cameras, pictures and all of its vertices but where they are;
/// materials keep their names. Throws std::runtime_error where it is none.
std::string relieved_gltf(std::string_view text);

/// The same with its buffer behind it.
std::string relieved_glb(std::string_view bytes);

}  // namespace scipd::sim
