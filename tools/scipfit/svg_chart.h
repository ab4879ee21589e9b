// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A drawing with two axes, as SVG for a page: dots, lines and bars, whose colours are classes of
// the page's style. What lies outside of the axes is drawn at their ends. One thread.
#pragma once

#include <string>
#include <vector>

namespace scipd::tools {

struct ChartPoint {
    double x = 0.0;
    double y = 0.0;
};

struct Axis {
    std::string label;  ///< with its unit
    double low = 0.0;
    double high = 1.0;
};

class SvgChart {
  public:
    SvgChart(Axis x, Axis y, double height = 240.0);

    void dots(const std::vector<ChartPoint>& points, const std::string& style);
    void line(const std::vector<ChartPoint>& points, const std::string& style);
    /// From the axis up to y; `wide` is in units of x.
    void bar(const ChartPoint& top, double wide, const std::string& style);
    /// A vertical line from one value of y to another.
    void interval(double x, double low, double high, const std::string& style);
    /// Words below a place of the x axis, in place of its numbers.
    void name(double x, const std::string& text);
    /// Words in the drawing.
    void text(const ChartPoint& at, const std::string& words, const std::string& style);

    [[nodiscard]] std::string svg() const;

  private:
    [[nodiscard]] double across(double x) const;
    [[nodiscard]] double down(double y) const;
    [[nodiscard]] std::string frame() const;

    Axis x_;
    Axis y_;
    double height_;
    std::string names_;
    std::string content_;
};

/// The value that all but some hundredths of these do not reach; 1 where there are none.
[[nodiscard]] double reach_of(std::vector<double> values);

}  // namespace scipd::tools
