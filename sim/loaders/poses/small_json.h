// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// JSON from anywhere, of which little is expected: reading it takes no longer than that is worth,
// however long and deep it is. Any thread; nothing shared.
#pragma once

#include <string_view>

#include <nlohmann/json.hpp>

namespace scipd::sim {

/// Throws std::runtime_error, with a sentence for whoever sent it, where it is no JSON, nests
/// deeper than a request or a pose line ever does, or has more values.
nlohmann::json parse_small_json(std::string_view text);

}  // namespace scipd::sim
