// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/sheet.h"

#include <algorithm>
#include <cmath>

namespace scipd::tools {
namespace {

void choose_font(cairo_t* context, double size, bool bold) {
    cairo_select_font_face(context, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context, size);
}

void use(cairo_t* context, const Colour& colour) {
    cairo_set_source_rgba(context, colour.red, colour.green, colour.blue, colour.opacity);
}

}  // namespace

Sheet::Sheet(cairo_t* context, const TopView& view) : context_(context), bounds_(view.bounds) {
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
    use(context_, colour);
    cairo_set_line_width(context_, width);
    cairo_stroke(context_);
}

void Sheet::fill(const Colour& colour) const {
    use(context_, colour);
    cairo_fill(context_);
}

void Sheet::write(const std::string& text, Spot spot, double size, const Colour& colour,
                  double anchor, bool bold) const {
    choose_font(context_, size, bold);
    cairo_text_extents_t extents;
    cairo_text_extents(context_, text.c_str(), &extents);
    move_to({spot.x - anchor * extents.x_advance, spot.y});
    use(context_, colour);
    cairo_show_text(context_, text.c_str());
}

void Sheet::write_label(const std::string& text, Spot spot, double size) const {
    constexpr double rim = 4.0;
    choose_font(context_, size, false);
    cairo_text_extents_t extents;
    cairo_text_extents(context_, text.c_str(), &extents);
    move_to({spot.x - extents.x_bearing - extents.width / 2.0,
             spot.y - extents.y_bearing - extents.height / 2.0});
    cairo_text_path(context_, text.c_str());
    cairo_set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
    use(context_, {1.0, 1.0, 1.0, 0.9});
    cairo_set_line_width(context_, rim);
    cairo_stroke_preserve(context_);
    fill(colours::faint_ink);
}

}  // namespace scipd::tools
