// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The media of a world as JSON, as users send and get them. Any thread; nothing shared.
#pragma once

#include <string>
#include <vector>

#include "daemon/api/documents.h"
#include "sim/expected.h"
#include "sim/world/medium.h"

namespace scipd::daemon {

/// [{"kind":"fog","visibility_m":20,"name":"mist","box":{"from":[0,0,0],"to":[2,2,3]}}, ..], in the
/// words of the configuration.
sim::Expected<std::vector<sim::Medium>> parse_media(const std::string& body);

/// What parse_media() reads.
Json media_document(const std::vector<sim::Medium>& media);

}  // namespace scipd::daemon
