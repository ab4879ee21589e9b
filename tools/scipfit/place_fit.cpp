// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/place_fit.h"

#include <utility>

#include "tools/scipfit/place_equations.h"

namespace scipd::tools {

void refine(const std::vector<Sight>& sights, PlaceFit& fit) {
    constexpr int steps = 12;
    for (int i = 0; i < steps; ++i) {
        PlaceEquations normal(fit);
        for (const PlaceRow& row : rows_of(sights, fit, spread_mm(sights, fit)))
            normal.add(row, 1.0, row.off);
        for (const PlaceRow& row : rows_of_places(fit))
            normal.add(row, 1.0, row.off);
        fit = normal.solved(std::move(fit));
    }
    fit.spread_mm = spread_mm(sights, fit);
}

}  // namespace scipd::tools
