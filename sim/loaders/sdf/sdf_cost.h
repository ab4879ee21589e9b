// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Estimates the memory that libsdformat takes for a document. Any thread; nothing shared.
#pragma once

#include <string>
#include <string_view>

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace scipd::sim {

/// Bytes for an element without its children.
double bytes_for(std::string_view element);

/// Bytes for a whole robot, whose links become SDF links.
double bytes_for_robot(const tinyxml2::XMLElement& element);

/// Text for messages, in megabytes.
std::string megabytes(double bytes);

}  // namespace scipd::sim
