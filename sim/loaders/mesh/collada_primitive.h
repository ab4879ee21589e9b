// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace scipd::sim {

/// A <mesh> whose triangles and polygons keep nothing of their corners but where they lie, and
/// whose polygons with holes have become triangles. Throws std::runtime_error where its numbers are
/// none.
void relieve_collada_mesh(tinyxml2::XMLElement& mesh);

}  // namespace scipd::sim
