// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What names may be, whoever gives them. Any thread; nothing shared.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace scipd::sim {

/// In bytes; of what lies in another, of each of the names between `::`. Every one so long fits
/// into a path of the control API.
inline constexpr std::size_t longest_name = 64;

/// Why a thing cannot be called so; empty where it can.
std::string name_fault(std::string_view name);

/// The name that something has here which its world has given a longer one: its beginning, `~` and
/// eight digits that come from the whole. A name that is short enough stays.
std::string short_name(std::string_view name);

}  // namespace scipd::sim
