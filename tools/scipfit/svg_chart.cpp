// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/svg_chart.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/formatted.h"
#include "tools/html_page.h"
#include "tools/markup.h"

namespace scipd::tools {
namespace {

constexpr double width = 960.0;
constexpr double left_rim = 60.0;
constexpr double right_rim = 20.0;
constexpr double top_rim = 10.0;
constexpr double bottom_rim = 44.0;

}  // namespace

SvgChart::SvgChart(Axis x, Axis y, double height)
    : x_(std::move(x)), y_(std::move(y)), height_(height) {}

double SvgChart::across(double x) const {
    const double share = std::clamp((x - x_.low) / (x_.high - x_.low), 0.0, 1.0);
    return left_rim + share * (width - left_rim - right_rim);
}

double SvgChart::down(double y) const {
    const double share = std::clamp((y_.high - y) / (y_.high - y_.low), 0.0, 1.0);
    return top_rim + share * (height_ - top_rim - bottom_rim);
}

void SvgChart::dots(const std::vector<ChartPoint>& points, const std::string& style) {
    for (const ChartPoint& point : points)
        content_ += formatted("<circle class=\"%s\" cx=\"%.1f\" cy=\"%.1f\" r=\"2\"/>\n",
                              style.c_str(), across(point.x), down(point.y));
}

void SvgChart::line(const std::vector<ChartPoint>& points, const std::string& style) {
    std::string path;
    for (const ChartPoint& point : points)
        path += formatted("%c%.1f %.1f", path.empty() ? 'M' : 'L', across(point.x), down(point.y));
    if (!path.empty()) content_ += "<path class=\"" + style + "\" d=\"" + path + "\"/>\n";
}

void SvgChart::bar(const ChartPoint& top, double wide, const std::string& style) {
    const double left = across(top.x - 0.5 * wide);
    content_ +=
        formatted("<rect class=\"%s\" x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"/>\n",
                  style.c_str(), left, down(top.y), across(top.x + 0.5 * wide) - left,
                  down(y_.low) - down(top.y));
}

void SvgChart::interval(double x, double low, double high, const std::string& style) {
    content_ += formatted("<line class=\"%s\" x1=\"%.1f\" x2=\"%.1f\" y1=\"%.1f\" y2=\"%.1f\"/>\n",
                          style.c_str(), across(x), across(x), down(low), down(high));
}

void SvgChart::name(double x, const std::string& text) {
    names_ += formatted("<text class=\"middle\" x=\"%.1f\" y=\"%.1f\">", across(x),
                        height_ - bottom_rim + 17.0) +
              in_markup(text) + "</text>\n";
}

void SvgChart::text(const ChartPoint& at, const std::string& words, const std::string& style) {
    content_ += formatted("<text class=\"%s\" x=\"%.1f\" y=\"%.1f\">", style.c_str(), across(at.x),
                          down(at.y) - 5.0) +
                in_markup(words) + "</text>\n";
}

std::string SvgChart::frame() const {
    std::string text;
    for (const double value : round_ticks(y_.low, y_.high, 4)) {
        text += formatted("<line class=\"grid\" x1=\"%.0f\" x2=\"%.0f\" y1=\"%.1f\" y2=\"%.1f\"/>",
                          left_rim, width - right_rim, down(value), down(value));
        text += formatted("<text class=\"right\" x=\"%.0f\" y=\"%.1f\">%.4g</text>\n",
                          left_rim - 6.0, down(value) + 4.0, value);
    }
    for (const double value :
         names_.empty() ? round_ticks(x_.low, x_.high, 8) : std::vector<double>())
        text += formatted("<text class=\"middle\" x=\"%.1f\" y=\"%.1f\">%.5g</text>\n",
                          across(value), height_ - bottom_rim + 17.0, value);
    text += formatted("<text class=\"right\" x=\"%.0f\" y=\"%.1f\">", width - right_rim,
                      height_ - bottom_rim + 36.0) +
            in_markup(x_.label) + "</text>\n";
    text += formatted("<text x=\"%.0f\" y=\"%.1f\">", left_rim, height_ - bottom_rim + 36.0) +
            in_markup("y: " + y_.label) + "</text>\n";
    return text;
}

std::string SvgChart::svg() const {
    return formatted("<svg viewBox=\"0 0 %.0f %.0f\" role=\"img\">\n", width, height_) + frame() +
           names_ + content_ + "</svg>\n";
}

double reach_of(std::vector<double> values) {
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    if (values.empty()) return 1.0;
    const std::size_t at = values.size() * 98 / 100;
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(at));
    return std::max(1.15 * values[at], 1e-9);
}

}  // namespace scipd::tools
