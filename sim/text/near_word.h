// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Finds the word that somebody meant who misspelt it. Any thread; nothing shared.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace scipd::sim {

/// Nothing where no known word is near.
std::optional<std::string_view> meant(std::string_view word,
                                      std::span<const std::string_view> known);

}  // namespace scipd::sim
