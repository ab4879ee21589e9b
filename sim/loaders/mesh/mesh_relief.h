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

}  // namespace scipd::sim
