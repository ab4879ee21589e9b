// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/colours.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace scipd::tools {

Colour viridis(double share) {
    constexpr std::array<Colour, 6> stops{{{0.267, 0.005, 0.329},
                                           {0.254, 0.265, 0.530},
                                           {0.164, 0.471, 0.558},
                                           {0.135, 0.659, 0.518},
                                           {0.478, 0.821, 0.318},
                                           {0.993, 0.906, 0.144}}};
    const double place = std::clamp(share, 0.0, 1.0) * (stops.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(place), stops.size() - 2);
    const double part = place - static_cast<double>(below);
    const Colour& a = stops[below];
    const Colour& b = stops[below + 1];
    return {a.red + part * (b.red - a.red), a.green + part * (b.green - a.green),
            a.blue + part * (b.blue - a.blue)};
}

}  // namespace scipd::tools
