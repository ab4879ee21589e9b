// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The compressed blocks and files of recordings. Any thread; nothing shared.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "sim/expected.h"

namespace scipd::sim {

/// No writer makes blocks of such a size, but a damaged length may ask for any.
inline constexpr std::size_t largest_block = std::size_t{256} << 20;

/// The whole block, packed by a method as files name it: "zstd", "lz4", "bz2", or not at all
/// ("none" and ""). Refuses what is damaged, is cut off, or makes more than largest_block, more
/// than a hundred times as much (scans are packed to a tenth of their size at best) or more than
/// `left`, which goes down by what is made.
[[nodiscard]] Expected<std::string> unpack(std::string_view method, std::string_view packed,
                                           std::uint64_t& left);

/// Piece after piece: `read` returns the next packed bytes, or none at the end, and `write` gets
/// what they make.
[[nodiscard]] Expected<> unpack_zstd(const std::function<Expected<std::string>()>& read,
                                     const std::function<Expected<>(std::string_view)>& write);

/// Packs by the method "zstd", "lz4" or "".
[[nodiscard]] std::string pack(std::string_view method, std::string_view bytes);

}  // namespace scipd::sim
