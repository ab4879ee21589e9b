// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Checks whether a text is SDF or URDF, and if not, says what it is. Any thread; nothing shared.
#pragma once

#include <string>

namespace tinyxml2 {
class XMLDocument;
}  // namespace tinyxml2

namespace scipd::sim {

/// For a text and the result of its Parse(): ":LINE: is ...", which says what it is instead. Empty
/// if it is SDF or URDF.
std::string why_no_sdf(const std::string& text, const tinyxml2::XMLDocument& parsed);

}  // namespace scipd::sim
