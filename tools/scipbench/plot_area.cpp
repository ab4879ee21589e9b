// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/plot_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "tools/html_page.h"

namespace scipd::tools {
namespace {

constexpr double left = 90.0;
constexpr double top = 108.0;
constexpr double width = Page::width - left - 40.0;
constexpr double height = 700.0;
constexpr double legend_top = top + height + 84.0;
constexpr double legend_line = 22.0;
constexpr int legend_rows = 6;
constexpr double smaller = 0.95;

void use(cairo_t* context, const Colour& colour) {
    cairo_set_source_rgba(context, colour.red, colour.green, colour.blue, colour.opacity);
}

void stroke(cairo_t* context, const Colour& colour, double line_width, bool dashed) {
    constexpr std::array dashes{6.0, 4.0};
    use(context, colour);
    cairo_set_line_width(context, line_width);
    cairo_set_dash(context, dashes.data(), dashed ? 2 : 0, 0.0);
    cairo_stroke(context);
    cairo_set_dash(context, nullptr, 0, 0.0);
}

std::string number(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%g", value);
    return text.data();
}

/// The numbers of an axis: powers of ten, or at most eight round intervals.
std::vector<double> ticks(const AxisRange& axis) {
    if (!axis.powers_of_ten) return round_ticks(axis.low, axis.high, 8);
    std::vector<double> values;
    for (double power = std::ceil(std::log10(axis.low)); power <= std::log10(axis.high); ++power)
        values.push_back(std::pow(10.0, power));
    return values;
}

}  // namespace

double AxisRange::share(double value) const {
    if (!powers_of_ten) return (value - low) / (high - low);
    return std::log(value / low) / std::log(high / low);
}

double PlotArea::page_height(std::size_t legend_lines) {
    if (legend_lines == 0) return top + height + 70.0;
    const auto rows = std::min<std::size_t>(legend_lines, legend_rows);
    return legend_top + static_cast<double>(rows) * legend_line + 20.0;
}

double PlotArea::aspect() {
    return width / height;
}

PlotArea::PlotArea(Page& page, const AxisRange& x, const AxisRange& y)
    : page_(page), context_(page.context()), x_(x), y_(y) {
    use(context_, colours::paper);
    cairo_paint(context_);
}

Place PlotArea::on_page(const Place& value) const {
    return {left + width * x_.share(value.x), top + height * (1.0 - y_.share(value.y))};
}

void PlotArea::numbers(const AxisRange& axis, bool along_x) {
    for (const double value : ticks(axis)) {
        const Place at = on_page({along_x ? value : x_.low, along_x ? y_.low : value});
        cairo_move_to(context_, at.x, at.y);
        cairo_line_to(context_, along_x ? at.x : left + width, along_x ? top : at.y);
        stroke(context_, colours::ring, 0.8, false);
        const Place label = along_x ? Place{at.x, at.y + 22.0} : Place{at.x - 8.0, at.y + 5.0};
        page_.write(number(value), label.x, label.y,
                    {15.0, colours::faint_ink, along_x ? 0.5 : 1.0});
    }
}

void PlotArea::grid(const std::string& x_title, const std::string& y_title) {
    numbers(x_, true);
    numbers(y_, false);
    cairo_rectangle(context_, left, top, width, height);
    stroke(context_, colours::frame, 1.5, false);
    page_.write(x_title, left + width / 2.0, top + height + 48.0, {16.0, colours::ink, 0.5});
    page_.write(y_title, left, top - 10.0, {16.0});
}

void PlotArea::line(const std::vector<Place>& values, const Colour& colour, double line_width,
                    bool dashed) {
    for (const Place& value : values) {
        const Place at = on_page(value);
        cairo_line_to(context_, at.x, at.y);
    }
    stroke(context_, colour, line_width, dashed);
}

void PlotArea::fill_square(const Place& middle, const Colour& colour, double radius) {
    cairo_rectangle(context_, middle.x - radius, middle.y - radius, 2.0 * radius, 2.0 * radius);
    use(context_, colour);
    cairo_fill(context_);
}

void PlotArea::dot(const Place& value, const Colour& colour, double radius) {
    fill_square(on_page(value), colour, radius);
}

std::size_t PlotArea::line_end(const std::string& text, double size) {
    std::size_t end = text.size();
    while (page_.length_of(text.substr(0, end), size) > width) {
        end = text.rfind(' ', end - 1);
        if (end == text.npos || end == 0) return 0;
    }
    return end;
}

void PlotArea::title(const std::string& text, const std::string& below) {
    double size = 22.0;
    while (page_.length_of(text, size) > width)
        size *= smaller;
    page_.write(text, left, 36.0, {size});

    size = 13.0;
    while (page_.length_of(below.substr(line_end(below, size)), size) > width)
        size *= smaller;
    const TextStyle style{size, colours::faint_ink};
    const std::size_t end = line_end(below, size);
    page_.write(below.substr(0, end), left, 58.0, style);
    const std::size_t rest = std::min(below.find_first_not_of(' ', end), below.size());
    page_.write(below.substr(rest), left, 74.0, style);
}

Place PlotArea::next_legend() {
    const Place begin{left + (legend_lines_ / legend_rows) * (width / 2.0),
                      legend_top + (legend_lines_ % legend_rows) * legend_line};
    ++legend_lines_;
    return begin;
}

void PlotArea::name_legend(const Place& begin, const std::string& text) {
    page_.write(text, begin.x + 50.0, begin.y, {13.0});
}

void PlotArea::legend(const std::string& text, const Colour& colour, double line_width,
                      bool dashed) {
    const Place begin = next_legend();
    cairo_move_to(context_, begin.x, begin.y - 5.0);
    cairo_line_to(context_, begin.x + 40.0, begin.y - 5.0);
    stroke(context_, colour, line_width, dashed);
    name_legend(begin, text);
}

void PlotArea::legend_of_dot(const std::string& text, const Colour& colour, double radius) {
    const Place begin = next_legend();
    fill_square({begin.x + 20.0, begin.y - 5.0}, colour, radius);
    name_legend(begin, text);
}

}  // namespace scipd::tools
