// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string>
#include <string_view>

namespace scipd::sim {

/// A glTF without animations, skins, cameras, pictures and all of its vertices but where they are;
/// materials keep their names. Throws std::runtime_error where it is none.
std::string relieved_gltf(std::string_view text);

/// The same with its buffer behind it.
std::string relieved_glb(std::string_view bytes);

}  // namespace scipd::sim
