// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What libsdformat takes of the memory for a document. Any thread; nothing shared.
#pragma once

#include <string>
#include <string_view>

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace scipd::sim {

/// For an element without what lies in it.
double bytes_for(std::string_view element);

/// For a whole robot: its links become links.
double bytes_for_robot(const tinyxml2::XMLElement& element);

/// For messages.
std::string megabytes(double bytes);

}  // namespace scipd::sim
