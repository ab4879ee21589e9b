// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace scipd::sim {

/// Reduces a <mesh>: of the corners of triangles and polygons only the positions stay, and polygons
/// with holes become triangles. Throws std::runtime_error if it cannot read the mesh's numbers, or
/// cannot make the triangles.
void relieve_collada_mesh(tinyxml2::XMLElement& mesh);

}  // namespace scipd::sim
