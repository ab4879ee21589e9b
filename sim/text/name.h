// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The rules for names, no matter who gives them. Any thread; nothing shared.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace scipd::sim {

/// In bytes. For a thing inside others, this limits each of the names between `::`. A name of this
/// length fits into a path of the control API.
inline constexpr std::size_t longest_name = 64;

/// Why a thing cannot have this name; empty if it can.
std::string name_fault(std::string_view name);

/// Shortens a name from a world that is longer than `longest_name`, to its beginning, `~` and eight
/// hexadecimal digits, which are a hash of the whole name. A shorter name stays.
std::string short_name(std::string_view name);

}  // namespace scipd::sim
