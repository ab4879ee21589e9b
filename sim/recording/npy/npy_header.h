// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the header of a .npy says of its array. A value; any thread.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "sim/expected.h"

namespace scipd::sim {

struct NpyHeader {
    char kind = 'f';  ///< f, i or u, as NumPy names them
    std::size_t item_bytes = 8;
    std::endian order = std::endian::little;
    std::vector<std::uint64_t> shape;
    std::uint64_t data_begin = 0;  ///< in the file
};

/// Takes the first bytes of the file, 64 KiB or all of them.
[[nodiscard]] Expected<NpyHeader> parse_npy_header(std::string_view bytes);

}  // namespace scipd::sim
