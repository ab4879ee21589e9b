// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A URDF robot as SDF, through libsdformat. Alone, the library drops every link without inertia,
// lumps links together where a joint is fixed and forgets the names of materials; a scanner sees
// shapes whatever they weigh, and wants to name what it sees. Call it while an SdfConsole is held.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace scipd::sim {

/// Whether the root of this XML is a <robot>.
bool is_urdf(std::string_view text);

/// The robot as an SDF document, every link of it, with all joints at zero. What the library has
/// against it is on the console; empty where it makes nothing of it.
std::string sdf_from_urdf(std::string_view text);

/// The lines of its links, by name.
std::map<std::string, int> lines_of_links(std::string_view text);

/// The line of the link or joint that a message of the library names in brackets; 0 where none.
int line_in_urdf(std::string_view text, const std::string& message);

}  // namespace scipd::sim
