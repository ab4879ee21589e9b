// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which element an error of libsdformat 12 is about: it has the path of some, the line of fewer,
// and of frames only a sentence. Any thread; nothing shared.
#pragma once

#include <sdf/Error.hh>

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace scipd::sim {

/// Null where nobody can tell.
tinyxml2::XMLElement* suspect_of(const sdf::Error& error, tinyxml2::XMLElement& root);

}  // namespace scipd::sim
