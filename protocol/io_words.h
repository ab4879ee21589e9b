// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <cstdint>

namespace scipd::protocol {

/// The wires beside the link, as GF, GG, MF and MG show them: 18 bits each.
struct IoWords {
    std::uint32_t inputs = 0;
    std::uint32_t outputs = 0;
};

}  // namespace scipd::protocol
