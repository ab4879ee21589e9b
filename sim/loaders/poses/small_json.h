// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads small JSON documents from anywhere. A document that is larger or deeper than any request or
// pose line costs no more time than one of theirs. Any thread; nothing shared.
#pragma once

#include <string_view>

#include <nlohmann/json.hpp>

#include "sim/expected.h"

namespace scipd::sim {

/// Refuses what is no JSON, nests deeper than a request or a pose line ever does, or has more
/// values than `most_values`, keys and ends of lists counted.
Expected<nlohmann::json> parse_small_json(std::string_view text, int most_values = 256);

/// As above, with members in the order of the text. Refuses a key that stands twice in one object,
/// with its name as the field: JSON leaves open which of its values counts.
Expected<nlohmann::ordered_json> parse_ordered_json(std::string_view text, int most_values = 256);

}  // namespace scipd::sim
