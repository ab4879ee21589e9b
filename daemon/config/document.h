// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Text into the one YAML document that a configuration is. Knows nothing of what is in it. Any
// thread; nothing shared.
#pragma once

#include <string>

#include <yaml-cpp/yaml.h>

#include "daemon/config/section.h"

namespace scipd::daemon {

/// No text at all is an empty map. Throws ConfigError where the text is no YAML; a second document
/// is a fault.
YAML::Node parse_document(const std::string& text, Faults& faults);

}  // namespace scipd::daemon
