// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/sheet.h"

#include <algorithm>
#include <cmath>

namespace scipd::tools {
namespace {

void use(cairo_t* context, const Colour& colour) {
    cairo_set_source_rgba(context, colour.red, colour.green, colour.blue, colour.opacity);
}

}  // namespace

Sheet::Sheet(Page& page, const TopView& view) : page_(page), bounds_(view.bounds) {
    const double longer_m = std::max(bounds_.width_m(), bounds_.height_m());
    units_per_m_ = side / longer_m;
    constexpr double rings_across = 10.0;
    ring_m_ = round_step_m(longer_m, rings_across);
}

double Sheet::reach_m() const {
    const double x_m = std::max(-bounds_.min_x_m, bounds_.max_x_m);
    const double y_m = std::max(-bounds_.min_y_m, bounds_.max_y_m);
    return std::hypot(x_m, y_m) + side / units_per_m_;
}

Spot Sheet::at(double x_m, double y_m) const {
    const double middle_x_m = (bounds_.min_x_m + bounds_.max_x_m) / 2.0;
    const double middle_y_m = (bounds_.min_y_m + bounds_.max_y_m) / 2.0;
    return {margin + side / 2.0 - units(y_m - middle_y_m),
            top + side / 2.0 - units(x_m - middle_x_m)};
}

Spot Sheet::at_polar(double range_m, double angle_rad) const {
    return at(range_m * std::cos(angle_rad), range_m * std::sin(angle_rad));
}

bool Sheet::holds(Spot spot, double border) const {
    const double x = spot.x - margin;
    const double y = spot.y - top;
    return std::min(x, y) > border && std::max(x, y) < side - border;
}

void Sheet::stroke(const Colour& colour, double width) const {
    use(context(), colour);
    cairo_set_line_width(context(), width);
    cairo_stroke(context());
}

void Sheet::fill(const Colour& colour) const {
    use(context(), colour);
    cairo_fill(context());
}

void Sheet::write(const std::string& text, Spot spot, double size, const Colour& colour,
                  double anchor, bool bold) const {
    page_.write(text, spot.x, spot.y, {size, colour, anchor, bold});
}

void Sheet::write_label(const std::string& text, Spot spot, double size) const {
    constexpr double half_a_digit = 0.36;  // of the size
    page_.write(text, spot.x, spot.y + half_a_digit * size,
                {.size = size, .colour = colours::faint_ink, .anchor = 0.5, .rimmed = true});
}

}  // namespace scipd::tools
