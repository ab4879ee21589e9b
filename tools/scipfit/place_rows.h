// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The equations of a PlaceFit, one for each reading and each place that was measured. Values; any
// thread.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tools/scipfit/place_fit.h"

namespace scipd::tools {

/// What one reading, or one measured place, says: it differs by `off` from the fit, and that
/// depends on a few parameters.
struct PlaceRow {
    std::array<std::size_t, 7> column{};
    std::array<double, 7> by{};
    std::size_t count = 0;
    double off = 0.0;
    double weight = 0.0;  ///< one over its variance
    std::size_t block = 0;

    void add(std::size_t at, double derivative) {
        column[count] = at;
        by[count++] = derivative;
    }
};

/// The parameters of a fit in a row: knots, then places, then faces.
class PlaceColumns {
  public:
    /// The fit must outlive it.
    explicit PlaceColumns(const PlaceFit& fit) : fit_(fit) {}

    [[nodiscard]] std::size_t of_place(std::size_t station) const {
        return fit_.knots_mm.size() + of_a_place * station;
    }
    [[nodiscard]] std::size_t of_face(std::size_t face) const {
        return of_place(fit_.places.size()) + of_a_face * face;
    }
    [[nodiscard]] std::size_t count() const {
        return of_face(fit_.fits_faces ? fit_.faces.size() : 0);
    }
    /// Too large an error of each.
    [[nodiscard]] double unit(std::size_t column) const;

    static constexpr std::size_t of_a_place = 3;

  private:
    static constexpr std::size_t of_a_face = 2;
    const PlaceFit& fit_;
};

/// `spread_mm`: what readings have beyond their noise. Those that are far off count less.
[[nodiscard]] std::vector<PlaceRow> rows_of(const std::vector<Sight>& sights, const PlaceFit& fit,
                                            double spread_mm);

/// What is known of places beforehand.
[[nodiscard]] std::vector<PlaceRow> rows_of_places(const PlaceFit& fit);

/// What readings have beyond their noise.
[[nodiscard]] double spread_mm(const std::vector<Sight>& sights, const PlaceFit& fit);

}  // namespace scipd::tools
