// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A frame on a page, with numbers along two axes and lines in it. One thread.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tools/colours.h"
#include "tools/page.h"

namespace scipd::tools {

/// The range of an axis, from left to right or from bottom to top.
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

    /// The frame's width divided by its height.
    static double aspect();
    /// The height of a page with this many lines of legend.
    static double page_height(std::size_t legend_lines);

    void grid(const std::string& x_title, const std::string& y_title);
    void line(const std::vector<Place>& values, const Colour& colour, double width, bool dashed);
    void dot(const Place& value, const Colour& colour, double radius);
    /// Writes the title in a size that fits, and `below` on two lines if it must.
    void title(const std::string& text, const std::string& below);
    /// Adds a line to the legend under the frame, for a line or for dots in it.
    void legend(const std::string& text, const Colour& colour, double width, bool dashed);
    void legend_of_dot(const std::string& text, const Colour& colour, double radius);

  private:
    [[nodiscard]] Place on_page(const Place& value) const;
    void fill_square(const Place& middle, const Colour& colour, double radius);
    /// Where the next line of the legend begins.
    [[nodiscard]] Place next_legend();
    void name_legend(const Place& begin, const std::string& text);
    /// The blank at which to break the text so that the first part fits into one line.
    [[nodiscard]] std::size_t line_end(const std::string& text, double size);
    void numbers(const AxisRange& axis, bool along_x);

    Page& page_;
    cairo_t* context_;
    AxisRange x_;
    AxisRange y_;
    int legend_lines_ = 0;
};

}  // namespace scipd::tools
