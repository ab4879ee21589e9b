// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Finds the element that an error of libsdformat 12 is about. Some errors have a path, fewer have a
// line, and those about frames have only a sentence. Any thread; nothing shared.
#pragma once

#include <sdf/Error.hh>

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace scipd::sim {

/// Null if the error does not tell.
tinyxml2::XMLElement* suspect_of(const sdf::Error& error, tinyxml2::XMLElement& root);

}  // namespace scipd::sim
