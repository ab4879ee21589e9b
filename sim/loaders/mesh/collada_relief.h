// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string>
#include <string_view>

namespace scipd::sim {

/// A COLLADA without animations, skins, cameras, lights, pictures, and all of its vertices but
/// where they are; what a skin covers stands in its first pose. Polygons with holes are triangles,
/// and counts are right. Throws std::runtime_error where it is none.
std::string relieved_collada(std::string_view text);

}  // namespace scipd::sim
