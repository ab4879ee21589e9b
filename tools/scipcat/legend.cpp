// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/legend.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <numbers>

namespace scipd::tools {
namespace {

constexpr double text_size = 14.0;
constexpr std::size_t columns = 5;
constexpr double row_height = 22.0;
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

void draw_scale(const Sheet& sheet, const Legend& legend) {
    constexpr double width = 220.0;
    constexpr double height = 12.0;
    constexpr double of_axes = 84.0;
    const double right = Sheet::margin + Sheet::side - of_axes;
    const double left = right - width;
    const double bar = Sheet::top - 46.0;
    const std::unique_ptr<cairo_pattern_t, decltype(&cairo_pattern_destroy)> gradient(
        cairo_pattern_create_linear(left, 0.0, right, 0.0), cairo_pattern_destroy);
    for (std::size_t i = 0; i < legend.scale.size(); ++i) {
        const auto& [red, green, blue, opacity] = legend.scale[i];
        const double share = static_cast<double>(i) / static_cast<double>(legend.scale.size() - 1);
        cairo_pattern_add_color_stop_rgb(gradient.get(), share, red, green, blue);
    }
    cairo_rectangle(sheet.context(), left, bar, width, height);
    cairo_set_source(sheet.context(), gradient.get());
    cairo_fill(sheet.context());

    const double below = bar + height + 18.0;
    sheet.write(legend.least, {left, below}, text_size, colours::faint_ink);
    sheet.write(legend.most, {right, below}, text_size, colours::faint_ink, 1.0);
    sheet.write(legend.title, {left, bar - 8.0}, text_size, colours::faint_ink);
}

struct Entry {
    std::string text;
    PointStyle style;
    int echo = 0;
};

std::vector<Entry> entries_of(const TopView& view, const Legend& legend) {
    std::vector<Entry> entries;
    for (const Legend::Name& name : legend.names)
        entries.push_back({name.text, name.style});
    const auto has = [&](int echo) {
        return std::ranges::any_of(view.further,
                                   [&](const ViewPoint& point) { return point.echo == echo; });
    };
    if (has(1)) entries.push_back({"second echo", {colours::ink}, 1});
    if (has(2)) entries.push_back({"third echo", {colours::ink}, 2});
    return entries;
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

double height_of_names(const TopView& view, const Legend& legend) {
    const std::size_t rows = (entries_of(view, legend).size() + columns - 1) / columns;
    return static_cast<double>(rows) * row_height;
}

void draw_legend(const Sheet& sheet, const TopView& view, const Legend& legend) {
    if (!legend.scale.empty()) draw_scale(sheet, legend);
    constexpr double width = Sheet::side / columns;
    constexpr double larger = 1.8;
    const std::vector<Entry> entries = entries_of(view, legend);
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const Spot spot{
            Sheet::margin + static_cast<double>(i % columns) * width + 6.0,
            Sheet::top + Sheet::side + 16.0 + static_cast<double>(i / columns) * row_height};
        draw_mark(sheet, spot, entries[i].style, entries[i].echo, larger);
        sheet.write(entries[i].text, {spot.x + 12.0, spot.y + 5.0}, text_size, colours::faint_ink);
    }
}

}  // namespace scipd::tools
