// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/polar_plot.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <numbers>

#include "tools/colours.h"
#include "tools/scipcat/point_colours.h"
#include "tools/scipcat/rings.h"
#include "tools/scipcat/sheet.h"

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

/// Draws a point: filled if it is the first echo of its beam, hollow if it is the second, a cross
/// if it is the third. `scale`: how much larger than usual.
void draw_mark(const Sheet& sheet, Spot spot, const PointStyle& style, int echo,
               double scale = 1.0) {
    const double size = scale * (style.shape == Shape::circle ? 1.0 : 1.25);
    if (echo == 0) {
        outline(sheet, spot, style.shape, size * radius);
        return sheet.fill(style.colour);
    }
    echo == 1 ? outline(sheet, spot, style.shape, size * hollow_radius)
              : cross(sheet, spot, size * radius);
    sheet.stroke(style.colour, stroke_width);
}

/// The height of the names below the plot, in the page's units.
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

void square(const Sheet& sheet) {
    cairo_rectangle(sheet.context(), Sheet::margin, Sheet::top, Sheet::side, Sheet::side);
}

/// Fills the area between the scanner and each run of neighbouring points.
void draw_free_space(const Sheet& sheet, const TopView& view) {
    for (const ViewPoint& point : view.points) {
        if (!point.adjacent) {
            cairo_close_path(sheet.context());
            sheet.move_to(sheet.at(0.0, 0.0));
        }
        sheet.line_to(sheet.at(point.x_m, point.y_m));
    }
    sheet.fill(colours::free_space);
}

void draw_edges_of_view(const Sheet& sheet, const TopView& view) {
    constexpr double dash[] = {5.0, 5.0};
    for (const double angle_rad : {view.first_angle_rad, view.last_angle_rad}) {
        sheet.move_to(sheet.at(0.0, 0.0));
        sheet.line_to(sheet.at_polar(sheet.reach_m(), angle_rad));
    }
    cairo_set_dash(sheet.context(), dash, 2, 0.0);
    sheet.stroke(colours::view_edge, 1.0);
    cairo_set_dash(sheet.context(), nullptr, 0, 0.0);
}

void draw_walls(const Sheet& sheet, const TopView& view, bool coloured) {
    for (const ViewPoint& point : view.points) {
        const Spot spot = sheet.at(point.x_m, point.y_m);
        point.joined ? sheet.line_to(spot) : sheet.move_to(spot);
    }
    cairo_set_line_join(sheet.context(), CAIRO_LINE_JOIN_ROUND);
    sheet.stroke(coloured ? colours::ring : colours::joint, 1.6);
}

void draw_points(const Sheet& sheet, const TopView& view, const Colouring& colouring) {
    for (std::size_t i = 0; i < view.further.size(); ++i) {
        const ViewPoint& point = view.further[i];
        draw_mark(sheet, sheet.at(point.x_m, point.y_m), colouring.further[i], point.echo);
    }
    for (std::size_t i = 0; i < view.points.size(); ++i) {
        const ViewPoint& point = view.points[i];
        draw_mark(sheet, sheet.at(point.x_m, point.y_m), colouring.points[i], 0);
    }
}

/// Draws the scanner as an arrow head that points forward.
void draw_scanner(const Sheet& sheet) {
    constexpr double size = 11.0;
    const Spot centre = sheet.at(0.0, 0.0);
    sheet.move_to({centre.x, centre.y - 1.3 * size});
    sheet.line_to({centre.x + size, centre.y + size});
    sheet.line_to({centre.x, centre.y + 0.5 * size});
    sheet.line_to({centre.x - size, centre.y + size});
    cairo_close_path(sheet.context());
    cairo_path_t* const outline = cairo_copy_path(sheet.context());
    sheet.stroke(colours::paper, 4.0);
    cairo_append_path(sheet.context(), outline);
    cairo_path_destroy(outline);
    sheet.fill(colours::scanner);
}

void draw_arrow(const Sheet& sheet, Spot from, double across, double down) {
    constexpr double length = 34.0;
    constexpr double head = 5.0;
    const Spot tip{from.x + across * length, from.y + down * length};
    sheet.move_to(from);
    sheet.line_to(tip);
    sheet.move_to({tip.x - head * (across - down), tip.y - head * (down + across)});
    sheet.line_to(tip);
    sheet.line_to({tip.x - head * (across + down), tip.y - head * (down - across)});
    sheet.stroke(colours::faint_ink, 1.6);
}

/// Draws arrows for x and y.
void draw_axes(const Sheet& sheet) {
    constexpr double text_size = 15.0;
    const Spot origin{Sheet::margin + Sheet::side - 16.0, Sheet::top - 16.0};
    draw_arrow(sheet, origin, 0.0, -1.0);
    draw_arrow(sheet, origin, -1.0, 0.0);
    sheet.write_label("x", {origin.x + 12.0, origin.y - 30.0}, text_size);
    sheet.write_label("y", {origin.x - 30.0, origin.y - 14.0}, text_size);
}

void draw_header(const Sheet& sheet, const PlotText& text) {
    const double left = Sheet::margin;
    sheet.write(text.title, {left, 46.0}, 27.0, colours::ink, 0.0, true);
    sheet.write(text.scanner, {left, 71.0}, 15.0, colours::faint_ink);
    sheet.write(text.scan, {left, 92.0}, 15.0, colours::faint_ink);
}

}  // namespace

double height_of_polar_plot(const TopView& view, const Colouring& colouring) {
    return Page::height + height_of_names(view, colouring.legend);
}

void draw_polar_plot(Page& page, const TopView& view, const Colouring& colouring,
                     const PlotText& text) {
    cairo_t* const context = page.context();
    const Sheet sheet(page, view);
    cairo_rectangle(context, 0.0, 0.0, Page::width, height_of_polar_plot(view, colouring));
    sheet.fill(colours::paper);

    cairo_save(context);
    square(sheet);
    cairo_clip(context);
    square(sheet);
    sheet.fill(colours::ground);
    draw_free_space(sheet, view);
    draw_rings(sheet);
    draw_edges_of_view(sheet, view);
    draw_walls(sheet, view, !colouring.legend.title.empty());
    draw_points(sheet, view, colouring);
    draw_scanner(sheet);
    draw_ring_labels(sheet, view);
    cairo_restore(context);

    square(sheet);
    sheet.stroke(colours::frame, 1.0);
    draw_header(sheet, text);
    draw_axes(sheet);
    draw_legend(sheet, view, colouring.legend);
}

}  // namespace scipd::tools
