// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/compare/svg_parts.h"

#include <algorithm>
#include <cmath>

#include "tools/formatted.h"
#include "tools/html_page.h"
#include "tools/markup.h"

namespace scipd::tools::comparing {
namespace {

constexpr double svg_width = 960;
constexpr double chart_height = 200;
constexpr double left_rim = 60;
constexpr double right_rim = 20;

const char* css_class_of(Mark mark) {
    switch (mark) {
        case Mark::nearer:
            return "nearer";
        case Mark::farther:
            return "farther";
        case Mark::otherwise:
            return "otherwise";
        case Mark::alike:
            break;
    }
    return "b";
}

/// From metres to the drawing's units; forward is up, and left is left.
struct Ground {
    double min_x = -0.3;
    double max_x = 0.3;
    double min_y = -0.3;
    double max_y = 0.3;

    void include(const SeenPoint& point) {
        min_x = std::min(min_x, point.x_m);
        max_x = std::max(max_x, point.x_m);
        min_y = std::min(min_y, point.y_m);
        max_y = std::max(max_y, point.y_m);
    }
    [[nodiscard]] double scale() const {
        constexpr double tallest = 760;
        return std::min((svg_width - 40) / (max_y - min_y), tallest / (max_x - min_x));
    }
    [[nodiscard]] double across(double y_m) const {
        return svg_width / 2 - scale() * (y_m - (min_y + max_y) / 2);
    }
    [[nodiscard]] double down(double x_m) const { return 20 + scale() * (max_x - x_m); }
};

std::string dots(const std::vector<SeenPoint>& points, const Ground& ground,
                 const std::vector<Mark>* marks) {
    std::string text;
    for (const SeenPoint& point : points) {
        const Mark mark = marks != nullptr ? (*marks)[point.pair] : Mark::alike;
        text += formatted("<circle class=\"%s\" cx=\"%.1f\" cy=\"%.1f\" r=\"%s\"/>\n",
                          marks == nullptr ? "a" : css_class_of(mark), ground.across(point.y_m),
                          ground.down(point.x_m), mark == Mark::alike ? "1.6" : "3");
    }
    return text;
}

/// A step of a chart, from left to right.
double place_of_step(const Comparison& comparison, std::size_t pair) {
    return left_rim +
           (svg_width - left_rim - right_rim) * static_cast<double>(pair) /
               static_cast<double>(std::max<std::size_t>(comparison.pairs.size(), 2) - 1);
}

double height_of(double value, double top, double bottom) {
    const double share = std::clamp((top - value) / (top - bottom), -0.02, 1.02);
    return 8 + (chart_height - 16) * share;
}

std::string chart_begins(const Comparison& comparison, double top, double bottom) {
    std::string text =
        formatted("<svg viewBox=\"0 0 %.0f %.0f\" role=\"img\">\n", svg_width, chart_height + 24);
    for (const double value : round_ticks(bottom, top, 4)) {
        const double y = height_of(value, top, bottom);
        text += formatted("<line class=\"grid\" x1=\"%.0f\" x2=\"%.0f\" y1=\"%.1f\" y2=\"%.1f\"/>",
                          left_rim, svg_width - right_rim, y, y);
        text += formatted("<text x=\"%.0f\" y=\"%.1f\" class=\"right\">%.4g</text>\n", left_rim - 6,
                          y + 4, value);
    }
    const auto& steps = comparison.steps;
    const int intervals = std::clamp(steps.back() - steps.front(), 1, 8);
    for (const double step : round_ticks(steps.front(), steps.back(), intervals)) {
        const auto pair = std::ranges::lower_bound(steps, static_cast<int>(step)) - steps.begin();
        text += formatted("<text x=\"%.0f\" y=\"%.0f\" class=\"middle\">%.0f</text>\n",
                          place_of_step(comparison, static_cast<std::size_t>(pair)),
                          chart_height + 16, step);
    }
    return text;
}

std::string curve_path(const Comparison& comparison, const std::vector<double>& values,
                       const char* name, double top) {
    std::string path;
    bool joined = false;
    for (std::size_t pair = 0; pair < values.size(); ++pair) {
        const bool known = std::isfinite(values[pair]);
        if (known)
            path += formatted("%c%.1f %.1f", joined ? 'L' : 'M', place_of_step(comparison, pair),
                              height_of(values[pair], top, 0));
        joined = known;
    }
    return formatted("<path class=\"%s\" d=\"", name) + path + "\"/>\n";
}

}  // namespace

std::string svg_from_above(const Comparison& comparison) {
    const auto a = points_of(comparison, true);
    const auto b = points_of(comparison, false);
    if (a.empty() && b.empty()) return {};
    Ground ground;
    for (const auto* const points : {&a, &b}) {
        for (const SeenPoint& point : *points)
            ground.include(point);
    }
    const auto marks = marks_of(comparison);
    std::string text = formatted("<svg viewBox=\"0 0 %.0f %.0f\" role=\"img\">\n", svg_width,
                                 ground.down(ground.min_x) + 20);
    text += dots(a, ground, nullptr) + dots(b, ground, &marks);
    text += formatted("<path class=\"scanner\" d=\"M%.1f %.1fl7 17l-7 -4l-7 4z\"/>\n",
                      ground.across(0), ground.down(0) - 9);
    for (const RunLabel& label : labels_of(comparison))
        text +=
            formatted("<text class=\"%s label\" x=\"%.1f\" y=\"%.1f\">", css_class_of(label.mark),
                      std::clamp(ground.across(label.at.y_m), 50.0, svg_width - 50),
                      ground.down(label.at.x_m) - 8) +
            in_markup(label.text) + "</text>\n";
    return text + "</svg>\n";
}

std::string svg_of_differences(const Comparison& comparison) {
    const double reach =
        std::fmax(reach_of(comparison.mean_differences_mm), 2 * comparison.floor.mean_mm);
    const double top = std::isfinite(reach) ? reach : 1;
    const auto marks = marks_of(comparison);
    std::string text = chart_begins(comparison, top, -top);
    if (std::isfinite(comparison.floor.mean_mm))
        text += formatted(
            "<rect class=\"floor\" x=\"%.0f\" width=\"%.0f\" y=\"%.1f\" height=\"%.1f\"/>\n",
            left_rim, svg_width - left_rim - right_rim,
            height_of(comparison.floor.mean_mm, top, -top),
            height_of(-comparison.floor.mean_mm, top, -top) -
                height_of(comparison.floor.mean_mm, top, -top));
    for (std::size_t pair = 0; pair < marks.size(); ++pair) {
        const double value = comparison.mean_differences_mm[pair];
        if (!std::isfinite(value)) continue;
        text += formatted("<circle class=\"%s\" cx=\"%.1f\" cy=\"%.1f\" r=\"%s\"/>\n",
                          css_class_of(marks[pair]), place_of_step(comparison, pair),
                          height_of(value, top, -top), marks[pair] == Mark::alike ? "1.6" : "2.4");
    }
    return text + "</svg>\n";
}

std::string svg_of_curves(const Comparison& comparison, const Curve& curve) {
    const double top = std::max(reach_of(curve.a), reach_of(curve.b));
    return chart_begins(comparison, top, 0) + curve_path(comparison, curve.a, "a", top) +
           curve_path(comparison, curve.b, "b", top) + "</svg>\n";
}

}  // namespace scipd::tools::comparing
