// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What names may be, whoever gives them. Any thread; nothing shared.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "sim/expected.h"

namespace scipd::sim {

/// In bytes, for each of the names between `::` where one thing lies in another. A name of this
/// length fits into a path of the control API.
inline constexpr std::size_t longest_name = 64;

/// Refuses what a thing cannot be called.
[[nodiscard]] Expected<> check_name(std::string_view name);

/// The name that is used for a thing whose world gives it a longer one: the beginning of that, `~`
/// and eight digits that are a hash of the whole. A name that is short enough stays as it is.
std::string short_name(std::string_view name);

}  // namespace scipd::sim
