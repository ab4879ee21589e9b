// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A frame on a page with numbers along two axes, and strokes in it. One thread.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tools/colours.h"
#include "tools/page.h"

namespace scipd::tools {

/// What an axis shows, from left or below.
struct AxisRange {
    double low;
    double high;
    bool powers_of_ten;

    [[nodiscard]] double share(double value) const;
};

struct Place {
    double x;
    double y;
};

class PlotArea {
  public:
    PlotArea(Page& page, const AxisRange& x, const AxisRange& y);

    /// How much wider it is than high.
    static double aspect();
    /// Of a page that has so many lines of legend.
    static double page_height(std::size_t legend_lines);

    void grid(const std::string& x_title, const std::string& y_title);
    void line(const std::vector<Place>& values, const Colour& colour, double width, bool dashed);
    void dot(const Place& value, const Colour& colour, double radius);
    /// As small as they must be to fit, `below` on two lines if need be.
    void title(const std::string& text, const std::string& below);
    /// The next line of the legend, under the frame.
    void legend(const std::string& text, const Colour& colour, double width, bool dashed);

  private:
    [[nodiscard]] Place on_page(const Place& value) const;
    void write(const std::string& text, const Place& at, double size, double anchor,
               const Colour& colour);
    [[nodiscard]] double length_of(const std::string& text, double size);
    /// Where the text is to be broken, at a blank, so that what is before fits into one line.
    [[nodiscard]] std::size_t line_end(const std::string& text, double size);
    void numbers(const AxisRange& axis, bool along_x);

    cairo_t* context_;
    AxisRange x_;
    AxisRange y_;
    int legend_lines_ = 0;
};

}  // namespace scipd::tools
