// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The lattice that a scanner's distances lie on, before it rounds them to millimetres. Pure.
#pragma once

#include <cstddef>

#include "tools/analysis/scan_table.h"

namespace scipd::tools {

struct Lattice {
    bool known = false;       ///< whether there is one, and which
    double spacing_mm = 0.0;  ///< 0: any millimetre occurs
    std::size_t cells = 0;    ///< millimetres around which there are many distances
    std::size_t missing = 0;  ///< of them those that never occur

    /// The variance that rounding to this lattice and to whole millimetres adds.
    [[nodiscard]] double rounding_mm2(bool whole_mm) const;
};

[[nodiscard]] Lattice lattice_of(const ScanTable& readings);

}  // namespace scipd::tools
