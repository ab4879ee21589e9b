// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Whether a text is SDF or URDF at all, and what it is otherwise. Any thread; nothing shared.
#pragma once

#include <string>

namespace tinyxml2 {
class XMLDocument;
}  // namespace tinyxml2

namespace scipd::sim {

/// Of a text that went through Parse(): ":LINE: is ..." what it is instead; empty where it is SDF
/// or URDF.
std::string why_no_sdf(const std::string& text, const tinyxml2::XMLDocument& parsed);

}  // namespace scipd::sim
