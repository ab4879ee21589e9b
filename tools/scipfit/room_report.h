// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How well a room fits, as people and programs read it. Any thread; nothing shared.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "tools/scipfit/room_fit.h"

namespace scipd::tools {

[[nodiscard]] nlohmann::ordered_json as_json(const Room& room);
/// Sentences, each on a line of its own.
[[nodiscard]] std::string as_text(const Room& room);

}  // namespace scipd::tools
