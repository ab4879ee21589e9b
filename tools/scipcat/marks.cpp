// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/marks.h"

#include <numbers>

namespace scipd::tools {
namespace {

constexpr double radius = 2.3;
constexpr double hollow_radius = 3.4;
constexpr double stroke_width = 1.3;

void outline(const Sheet& sheet, Spot spot, Shape shape, double size) {
    cairo_new_sub_path(sheet.context());
    if (shape == Shape::circle)
        return cairo_arc(sheet.context(), spot.x, spot.y, size, 0.0, 2.0 * std::numbers::pi);
    if (shape == Shape::square)
        return cairo_rectangle(sheet.context(), spot.x - size, spot.y - size, 2.0 * size,
                               2.0 * size);
    sheet.move_to({spot.x, spot.y - 1.4 * size});
    sheet.line_to({spot.x + 1.2 * size, spot.y + size});
    sheet.line_to({spot.x - 1.2 * size, spot.y + size});
    cairo_close_path(sheet.context());
}

void cross(const Sheet& sheet, Spot spot, double size) {
    sheet.move_to({spot.x - size, spot.y - size});
    sheet.line_to({spot.x + size, spot.y + size});
    sheet.move_to({spot.x - size, spot.y + size});
    sheet.line_to({spot.x + size, spot.y - size});
}

}  // namespace

void draw_mark(const Sheet& sheet, Spot spot, const PointStyle& style, int echo, double scale) {
    const double size = scale * (style.shape == Shape::circle ? 1.0 : 1.25);
    if (echo == 0) {
        outline(sheet, spot, style.shape, size * radius);
        return sheet.fill(style.colour);
    }
    echo == 1 ? outline(sheet, spot, style.shape, size * hollow_radius)
              : cross(sheet, spot, size * radius);
    sheet.stroke(style.colour, stroke_width);
}

}  // namespace scipd::tools
