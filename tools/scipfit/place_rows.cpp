// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/place_rows.h"

#include <algorithm>
#include <cmath>

namespace scipd::tools {
namespace {

/// Deviations of a reading from which on it counts little.
constexpr double outlier = 3.0;

PlaceRow row_of(const Sight& sight, const PlaceFit& fit, const PlaceColumns& columns) {
    const FlatPose& place = fit.places[sight.station];
    const FaceLine& face = fit.faces[sight.face];
    const double direction = place.yaw_rad + sight.angle_rad;
    const double c = std::cos(direction - face.normal_rad);
    const double t = std::tan(direction - face.normal_rad);
    const double range = face.range_mm(place, direction);
    const Hats hats = hats_at(fit.knots_mm, range);
    PlaceRow row;
    double bias = 0.0;
    for (std::size_t i = 0; i < hats.knot.size(); ++i) {
        bias += hats.share[i] * fit.bias_mm[hats.knot[i]];
        if (hats.share[i] > 0.0) row.add(hats.knot[i], hats.share[i]);
    }
    const std::size_t at = columns.of_place(sight.station);
    row.add(at, -std::cos(face.normal_rad) / c);
    row.add(at + 1, -std::sin(face.normal_rad) / c);
    row.add(at + 2, range * t);
    if (fit.fits_faces) {
        const double along =
            place.x_mm * std::sin(face.normal_rad) - place.y_mm * std::cos(face.normal_rad);
        row.add(columns.of_face(sight.face), along / c - range * t);
        row.add(columns.of_face(sight.face) + 1, 1.0 / c);
    }
    row.off = sight.range_mm - range - bias;
    return row;
}

}  // namespace

double PlaceColumns::unit(std::size_t column) const {
    constexpr double bias_mm = 5.0;
    constexpr double place_mm = 5.0;
    constexpr double angle_rad = 0.005;
    if (column < of_place(0)) return bias_mm;
    if (column < of_face(0)) return (column - of_place(0)) % of_a_place == 2 ? angle_rad : place_mm;
    return (column - of_face(0)) % of_a_face == 1 ? place_mm : angle_rad;
}

std::vector<PlaceRow> rows_of(const std::vector<Sight>& sights, const PlaceFit& fit,
                              double spread_mm) {
    const PlaceColumns columns(fit);
    std::vector<PlaceRow> rows;
    for (const Sight& sight : sights) {
        PlaceRow row = row_of(sight, fit, columns);
        row.block = (sight.station << 32U) + sight.beam / beams_of_block;
        const double variance = sight.deviation_mm * sight.deviation_mm + spread_mm * spread_mm;
        row.weight = 1.0 / (variance + row.off * row.off / (outlier * outlier));
        rows.push_back(row);
    }
    return rows;
}

std::vector<PlaceRow> rows_of_places(const PlaceFit& fit) {
    const PlaceColumns columns(fit);
    std::vector<PlaceRow> rows;
    for (std::size_t i = 0; i < fit.places.size(); ++i) {
        const FlatPose& given = fit.given[i];
        const FlatPose& now = fit.places[i];
        const std::array off{given.x_mm - now.x_mm, given.y_mm - now.y_mm,
                             given.yaw_rad - now.yaw_rad};
        const PlaceError& error = fit.errors[i];
        const std::array errors{error.mm, error.mm, error.yaw_rad};
        for (std::size_t k = 0; k < PlaceColumns::of_a_place && std::isfinite(error.mm); ++k) {
            PlaceRow row;
            row.add(columns.of_place(i) + k, 1.0);
            row.off = off[k];
            row.weight = 1.0 / (errors[k] * errors[k]);
            rows.push_back(row);
        }
    }
    return rows;
}

/// Beyond the noise: 1.4826 times the median is the deviation, where most are normally distributed.
double spread_mm(const std::vector<Sight>& sights, const PlaceFit& fit) {
    constexpr double deviation_of_median = 1.4826;
    constexpr double least_mm = 0.2;
    if (sights.empty()) return least_mm;
    std::vector<double> off;
    double noise = 0.0;
    for (const Sight& sight : sights) {
        off.push_back(std::abs(off_mm(sight, fit)));
        noise += sight.deviation_mm * sight.deviation_mm / static_cast<double>(sights.size());
    }
    const auto middle = off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2);
    std::ranges::nth_element(off, middle);
    const double all = deviation_of_median * *middle;
    return std::sqrt(std::max(least_mm * least_mm, all * all - noise));
}

double off_mm(const Sight& sight, const PlaceFit& fit) {
    return row_of(sight, fit, PlaceColumns(fit)).off;
}

}  // namespace scipd::tools
