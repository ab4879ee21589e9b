// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Numbers of a map, as users write and read them. Any thread; nothing shared.
#pragma once

#include <string>
#include <string_view>

#include "sim/expected.h"

namespace scipd::sim {

struct HeightBand {
    double low_m = 0.0;
    double high_m = 0.0;
};

/// Z or LOW:HIGH in metres.
Expected<HeightBand> parse_heights(std::string_view text);

/// Metres, 0.0001 to 100: the side of a cell.
Expected<double> parse_cell_size(std::string_view text);

/// Up to nine digits, without zeros at the end.
std::string short_text(double value);

}  // namespace scipd::sim
