// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Prints XML so that later messages still name the lines of the original file. Any thread.
#pragma once

#include <string>

namespace tinyxml2 {
class XMLDocument;
}

namespace scipd::sim {

/// Each element of the text begins on the line where it was parsed.
std::string line_for_line(const tinyxml2::XMLDocument& document);

}  // namespace scipd::sim
