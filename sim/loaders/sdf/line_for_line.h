// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// XML back into text, so that what reads it after us names the lines of the file. Any thread.
#pragma once

#include <string>

namespace tinyxml2 {
class XMLDocument;
}

namespace scipd::sim {

/// Every element begins on the line that it had when it was parsed.
std::string line_for_line(const tinyxml2::XMLDocument& document);

}  // namespace scipd::sim
