// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/export/map_values.h"

#include <array>
#include <cstdio>

#include "sim/text/quote.h"
#include "sim/text/text_number.h"

namespace scipd::sim {

Expected<HeightBand> parse_heights(std::string_view text) {
    const auto colon = text.find(':');
    const auto low = parse_number(text.substr(0, colon));
    const auto high = colon == text.npos ? low : parse_number(text.substr(colon + 1));
    if (low && high && *low <= *high) return HeightBand{*low, *high};
    return refuse("must be a height in m such as 0.17, or LOW:HIGH such as 0.1:0.4, not " +
                  quote(text));
}

Expected<double> parse_cell_size(std::string_view text) {
    const auto size_m = parse_number(text);
    if (size_m && *size_m >= 1e-4 && *size_m <= 100.0) return *size_m;
    return refuse("must be 0.0001 to 100 m, not " + quote(text));
}

std::string short_text(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.9g", value);
    return text.data();
}

}  // namespace scipd::sim
