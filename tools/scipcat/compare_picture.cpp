// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/compare_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "tools/colours.h"
#include "tools/html_page.h"
#include "tools/page.h"
#include "tools/scipcat/compare/comparison_view.h"
#include "tools/scipcat/compare/comparison_words.h"
#include "tools/scipcat/rings.h"
#include "tools/scipcat/sheet.h"
#include "tools/scipcat/top_view.h"

namespace scipd::tools {
namespace {

using comparing::Comparison;
using comparing::Mark;
using comparing::SeenPoint;

constexpr double chart_top = Sheet::top + Sheet::side + 40;
constexpr double chart_height = 190;
constexpr double list_top = chart_top + chart_height + 50;
constexpr double line_height = 24;
constexpr std::size_t most_listed = 8;

constexpr Colour of_a{0.55, 0.59, 0.64};
constexpr Colour floor_band{0.55, 0.59, 0.64, 0.25};

Colour colour_of(Mark mark) {
    switch (mark) {
        case Mark::nearer:
            return {0.82, 0.14, 0.18};
        case Mark::farther:
            return {0.51, 0.31, 0.87};
        case Mark::otherwise:
            return {0.70, 0.35, 0.0};
        case Mark::alike:
            break;
    }
    return colours::wall;
}

/// All points of both, so that the sheet holds them.
TopView view_of(const std::vector<SeenPoint>& a, const std::vector<SeenPoint>& b) {
    TopView view;
    for (const auto* const points : {&a, &b}) {
        for (const SeenPoint& point : *points) {
            view.points.push_back({.x_m = point.x_m, .y_m = point.y_m});
            view.bounds.include(point.x_m, point.y_m);
        }
    }
    view.bounds.widen(
        std::max(0.3, 0.04 * std::max(view.bounds.width_m(), view.bounds.height_m())));
    return view;
}

void dot(const Sheet& sheet, Spot spot, double radius, const Colour& colour) {
    cairo_new_sub_path(sheet.context());
    cairo_arc(sheet.context(), spot.x, spot.y, radius, 0, 6.2832);
    sheet.fill(colour);
}

void draw_from_above(const Sheet& sheet, const TopView& view, const Comparison& comparison,
                     const std::vector<SeenPoint>& a, const std::vector<SeenPoint>& b) {
    const auto marks = comparing::marks_of(comparison);
    cairo_save(sheet.context());
    cairo_rectangle(sheet.context(), Sheet::margin, Sheet::top, Sheet::side, Sheet::side);
    cairo_clip_preserve(sheet.context());
    sheet.fill(colours::ground);
    draw_rings(sheet);
    for (const SeenPoint& point : a)
        dot(sheet, sheet.at(point.x_m, point.y_m), 2, of_a);
    for (const SeenPoint& point : b) {
        const Mark mark = marks[point.pair];
        dot(sheet, sheet.at(point.x_m, point.y_m), mark == Mark::alike ? 1.8 : 3.4,
            colour_of(mark));
    }
    dot(sheet, sheet.at(0, 0), 7, colours::scanner);
    draw_ring_labels(sheet, view);
    for (const comparing::RunLabel& label : comparing::labels_of(comparison)) {
        Spot spot = sheet.at(label.at.x_m, label.at.y_m);
        spot.x = std::clamp(spot.x, Sheet::margin + 60, Sheet::margin + Sheet::side - 60);
        sheet.write(label.text, {spot.x, spot.y - 10}, 17, colour_of(label.mark), 0.5, true);
    }
    cairo_restore(sheet.context());
    cairo_rectangle(sheet.context(), Sheet::margin, Sheet::top, Sheet::side, Sheet::side);
    sheet.stroke(colours::frame, 1);
}

/// Millimetres that B is farther, step by step.
void draw_differences(const Sheet& sheet, const Comparison& comparison) {
    const auto& values = comparison.mean_differences_mm;
    const auto marks = comparing::marks_of(comparison);
    const double floor_mm = std::fmax(0, comparison.floor.mean_mm);
    const double reach_mm = std::fmax(comparing::reach_of(values), 2 * floor_mm);
    const double middle = chart_top + chart_height / 2;
    const auto height = [&](double value_mm) {
        return middle - chart_height / 2 * std::clamp(value_mm / reach_mm, -1.0, 1.0);
    };
    cairo_rectangle(sheet.context(), Sheet::margin, height(floor_mm), Sheet::side,
                    height(-floor_mm) - height(floor_mm));
    sheet.fill(floor_band);
    for (std::size_t pair = 0; pair < values.size(); ++pair) {
        if (!std::isfinite(values[pair])) continue;
        const double share = static_cast<double>(pair) / static_cast<double>(values.size());
        dot(sheet, {Sheet::margin + Sheet::side * share, height(values[pair])},
            marks[pair] == Mark::alike ? 1.6 : 2.6, colour_of(marks[pair]));
    }
    cairo_rectangle(sheet.context(), Sheet::margin, chart_top, Sheet::side, chart_height);
    sheet.stroke(colours::frame, 1);
    for (const double tick_mm : round_ticks(-reach_mm, reach_mm, 4)) {
        char text[60];
        std::snprintf(text, sizeof text, tick_mm == 0 ? "%.0f mm" : "%+.3g mm", tick_mm);
        sheet.write(text, {Sheet::margin + 6, height(tick_mm) + 5}, 14, colours::faint_ink);
    }
    sheet.write("How much farther B is, by step; the band is what A's halves differ by",
                {Sheet::margin, chart_top - 10}, 15, colours::faint_ink);
    const double below = chart_top + chart_height + 18;
    sheet.write("step " + std::to_string(comparison.steps.front()), {Sheet::margin, below}, 14,
                colours::faint_ink);
    sheet.write(std::to_string(comparison.steps.back()), {Sheet::margin + Sheet::side, below}, 14,
                colours::faint_ink, 1);
}

void draw_words(const Sheet& sheet, const Comparison& comparison) {
    sheet.write(comparison.alike() ? "Alike" : "B differs from A", {Sheet::margin, 46}, 27,
                colours::ink, 0, true);
    sheet.write("A  " + comparison.a.name + ": " + scanner_of(comparison.a), {Sheet::margin, 71},
                15, of_a);
    sheet.write("B  " + comparison.b.name + ": " + scanner_of(comparison.b), {Sheet::margin, 92},
                15, colours::wall);
    double y = list_top;
    sheet.write(comparing::verdict_of(comparison), {Sheet::margin, y}, 17, colours::ink, 0, true);
    const auto differences = comparing::weightiest_first(comparison.differ);
    for (std::size_t i = 0; i < std::min(differences.size(), most_listed); ++i)
        sheet.write(comparing::sentence_of(differences[i]), {Sheet::margin + 16, y += line_height},
                    16, colours::ink);
    if (differences.size() > most_listed)
        sheet.write("and " + std::to_string(differences.size() - most_listed) + " more",
                    {Sheet::margin + 16, y + line_height}, 16, colours::faint_ink);
}

}  // namespace

void draw_comparison(const std::filesystem::path& file, const Comparison& comparison) {
    const std::size_t lines = std::min(comparison.differ.size(), most_listed + 1);
    const double height = list_top + line_height * (static_cast<double>(lines) + 1);
    Page page(file, height);
    const auto a = comparing::points_of(comparison, true);
    const auto b = comparing::points_of(comparison, false);
    const TopView view = view_of(a, b);
    const Sheet sheet(page, view);
    cairo_rectangle(page.context(), 0, 0, Page::width, height);
    sheet.fill(colours::paper);
    draw_from_above(sheet, view, comparison, a, b);
    draw_differences(sheet, comparison);
    draw_words(sheet, comparison);
    if (const auto trouble = page.finish())
        throw std::runtime_error("cannot write " + file.string() + ": " + *trouble);
}

}  // namespace scipd::tools
