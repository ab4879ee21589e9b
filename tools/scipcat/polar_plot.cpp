// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/polar_plot.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "tools/colours.h"
#include "tools/scipcat/ring_labels.h"
#include "tools/scipcat/sheet.h"

namespace scipd::tools {
namespace {

constexpr double turn_rad = 2.0 * std::numbers::pi;

/// The scale is logarithmic, because returns fade with the square of their distance. It leaves out
/// the few strongest and weakest ones: otherwise one reflector would leave a single colour for
/// everything else.
struct IntensityScale {
    std::uint32_t least = 1;
    std::uint32_t most = 1;

    [[nodiscard]] Colour colour(std::uint32_t intensity) const {
        const double span = std::log(static_cast<double>(most) / least);
        const double place = std::log(std::max(1.0, static_cast<double>(intensity)) / least);
        return viridis(span > 0.0 ? place / span : 1.0);
    }
};

IntensityScale scale_of(const TopView& view) {
    if (view.points.empty()) return {};
    std::vector<std::uint32_t> intensities;
    for (const ViewPoint& point : view.points)
        intensities.push_back(point.intensity);
    std::ranges::sort(intensities);
    const std::size_t left_out = intensities.size() / 20;
    const std::uint32_t weakest = 1;
    return {std::max(weakest, intensities[left_out]),
            std::max(weakest, intensities[intensities.size() - 1 - left_out])};
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

void draw_rings(const Sheet& sheet) {
    const Spot centre = sheet.at(0.0, 0.0);
    for (double range_m = sheet.ring_m(); range_m < sheet.reach_m(); range_m += sheet.ring_m()) {
        cairo_new_sub_path(sheet.context());
        cairo_arc(sheet.context(), centre.x, centre.y, sheet.units(range_m), 0.0, turn_rad);
    }
    sheet.stroke(colours::ring, 1.0);
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

void draw_walls(const Sheet& sheet, const TopView& view) {
    for (const ViewPoint& point : view.points) {
        const Spot spot = sheet.at(point.x_m, point.y_m);
        point.joined ? sheet.line_to(spot) : sheet.move_to(spot);
    }
    cairo_set_line_join(sheet.context(), CAIRO_LINE_JOIN_ROUND);
    sheet.stroke(view.has_intensity ? colours::ring : colours::joint, 1.6);
}

void draw_points(const Sheet& sheet, const TopView& view) {
    constexpr double radius = 2.3;
    const IntensityScale scale = scale_of(view);
    for (const ViewPoint& point : view.points) {
        const Spot spot = sheet.at(point.x_m, point.y_m);
        cairo_arc(sheet.context(), spot.x, spot.y, radius, 0.0, turn_rad);
        sheet.fill(view.has_intensity ? scale.colour(point.intensity) : colours::wall);
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

void draw_legend(const Sheet& sheet, const TopView& view) {
    constexpr double width = 220.0;
    constexpr double height = 12.0;
    constexpr double text_size = 14.0;
    constexpr double of_axes = 84.0;
    const double right = Sheet::margin + Sheet::side - of_axes;
    const double left = right - width;
    const double bar = Sheet::top - 46.0;
    const std::unique_ptr<cairo_pattern_t, decltype(&cairo_pattern_destroy)> gradient(
        cairo_pattern_create_linear(left, 0.0, right, 0.0), cairo_pattern_destroy);
    constexpr int stops = 20;
    for (int i = 0; i <= stops; ++i) {
        const double share = static_cast<double>(i) / stops;
        const Colour colour = viridis(share);
        cairo_pattern_add_color_stop_rgb(gradient.get(), share, colour.red, colour.green,
                                         colour.blue);
    }
    cairo_rectangle(sheet.context(), left, bar, width, height);
    cairo_set_source(sheet.context(), gradient.get());
    cairo_fill(sheet.context());

    const IntensityScale scale = scale_of(view);
    const double below = bar + height + 18.0;
    sheet.write(std::to_string(scale.least), {left, below}, text_size, colours::faint_ink);
    sheet.write(std::to_string(scale.most), {right, below}, text_size, colours::faint_ink, 1.0);
    sheet.write("intensity, logarithmic", {left, bar - 8.0}, text_size, colours::faint_ink);
}

void draw_header(const Sheet& sheet, const PlotText& text) {
    const double left = Sheet::margin;
    sheet.write(text.title, {left, 46.0}, 27.0, colours::ink, 0.0, true);
    sheet.write(text.scanner, {left, 71.0}, 15.0, colours::faint_ink);
    sheet.write(text.scan, {left, 92.0}, 15.0, colours::faint_ink);
}

}  // namespace

void draw_polar_plot(cairo_t* context, const TopView& view, const PlotText& text) {
    const Sheet sheet(context, view);
    cairo_rectangle(context, 0.0, 0.0, 2.0 * Sheet::top + Sheet::side,
                    2.0 * Sheet::top + Sheet::side);
    sheet.fill(colours::paper);

    cairo_save(context);
    square(sheet);
    cairo_clip(context);
    square(sheet);
    sheet.fill(colours::ground);
    draw_free_space(sheet, view);
    draw_rings(sheet);
    draw_edges_of_view(sheet, view);
    draw_walls(sheet, view);
    draw_points(sheet, view);
    draw_scanner(sheet);
    draw_ring_labels(sheet, view);
    cairo_restore(context);

    square(sheet);
    sheet.stroke(colours::frame, 1.0);
    draw_header(sheet, text);
    draw_axes(sheet);
    if (view.has_intensity) draw_legend(sheet, view);
}

}  // namespace scipd::tools
