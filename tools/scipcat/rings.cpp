// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/rings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "tools/colours.h"

namespace scipd::tools {
namespace {

constexpr double border = 26.0;
constexpr double room = 30.0;  ///< a label that is this far from all points has room enough

/// What labels keep away from: the points and the edges of the field of view.
std::vector<Spot> spots_of(const TopView& view, const Sheet& sheet) {
    std::vector<Spot> spots;
    for (const ViewPoint& point : view.points)
        spots.push_back(sheet.at(point.x_m, point.y_m));
    const double step_m = sheet.ring_m() / 10.0;
    for (const double angle_rad : {view.first_angle_rad, view.last_angle_rad}) {
        for (double range_m = 0.0; range_m < sheet.reach_m(); range_m += step_m)
            spots.push_back(sheet.at_polar(range_m, angle_rad));
    }
    return spots;
}

/// The distance to the nearest spot, at most `room`.
double clearance(Spot label, const std::vector<Spot>& spots) {
    double nearest = room;
    for (const Spot& spot : spots)
        nearest = std::min(nearest, std::hypot(spot.x - label.x, spot.y - label.y));
    return nearest;
}

/// How good this direction is for the labels: the sum of their clearances.
double score(const Sheet& sheet, const std::vector<Spot>& spots, double angle_rad) {
    double sum = 0.0;
    for (double range_m = sheet.ring_m(); range_m < sheet.reach_m(); range_m += sheet.ring_m()) {
        const Spot spot = sheet.at_polar(range_m, angle_rad);
        if (sheet.holds(spot, border)) sum += clearance(spot, spots);
    }
    return sum;
}

double best_angle_rad(const Sheet& sheet, const TopView& view) {
    constexpr int directions = 72;
    const std::vector<Spot> spots = spots_of(view, sheet);
    double best_rad = 0.0;
    double best = -1.0;
    for (int i = 0; i < directions; ++i) {
        const double angle_rad = 2.0 * std::numbers::pi * i / directions;
        const double worth = score(sheet, spots, angle_rad);
        if (worth > best) {
            best = worth;
            best_rad = angle_rad;
        }
    }
    return best_rad;
}

}  // namespace

void draw_rings(const Sheet& sheet) {
    const Spot centre = sheet.at(0.0, 0.0);
    for (double range_m = sheet.ring_m(); range_m < sheet.reach_m(); range_m += sheet.ring_m()) {
        cairo_new_sub_path(sheet.context());
        cairo_arc(sheet.context(), centre.x, centre.y, sheet.units(range_m), 0.0,
                  2.0 * std::numbers::pi);
    }
    sheet.stroke(colours::ring, 1.0);
}

void draw_ring_labels(const Sheet& sheet, const TopView& view) {
    constexpr double text_size = 14.5;
    const double angle_rad = best_angle_rad(sheet, view);
    for (double range_m = sheet.ring_m(); range_m < sheet.reach_m(); range_m += sheet.ring_m()) {
        const Spot spot = sheet.at_polar(range_m, angle_rad);
        if (!sheet.holds(spot, border)) continue;
        std::ostringstream text;
        text << range_m << " m";
        sheet.write_label(text.str(), spot, text_size);
    }
}

}  // namespace scipd::tools
