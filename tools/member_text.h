// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Members of JSON objects as people type them: KEY=VALUE. Values; no thread rule.
#pragma once

#include <string>
#include <utility>

#include <nlohmann/json.hpp>

namespace scipd::tools {

// All three throw WrongInput, with `examples` of what is right.

/// KEY and VALUE.
[[nodiscard]] std::pair<std::string, std::string> pair_of(const std::string& text,
                                                          const std::string& examples);
/// A value in YAML.
[[nodiscard]] nlohmann::ordered_json value_of(const std::string& text);
/// Adds KEY=VALUE to a map: the value is YAML, and dots in the key nest.
void add_member(nlohmann::ordered_json& map, const std::string& text, const std::string& examples);

}  // namespace scipd::tools
