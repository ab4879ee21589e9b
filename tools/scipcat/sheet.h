// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Maps the view onto the page, and draws the few strokes that all parts use. One thread.
//
//   header    title, scanner, scan      legend
//   ┌──────────────────────────────────────┐
//   │                  ▲ x                  │
//   │              y ◄─┘                    │
//   └──────────────────────────────────────┘
#pragma once

#include <string>

#include <cairo.h>

#include "tools/colours.h"
#include "tools/page.h"
#include "tools/scipcat/top_view.h"

namespace scipd::tools {

/// A point on the page: x to the right, y down, in the page's units.
struct Spot {
    double x;
    double y;
};

class Sheet {
  public:
    static constexpr double margin = 32.0;
    static constexpr double top = 106.0;
    static constexpr double side = 936.0;  ///< side of the square that holds the view

    Sheet(Page& page, const TopView& view);

    [[nodiscard]] cairo_t* context() const { return page_.context(); }
    [[nodiscard]] double ring_m() const { return ring_m_; }
    /// The largest radius at which a ring may be visible.
    [[nodiscard]] double reach_m() const;

    [[nodiscard]] Spot at(double x_m, double y_m) const;
    [[nodiscard]] Spot at_polar(double range_m, double angle_rad) const;
    [[nodiscard]] double units(double length_m) const { return length_m * units_per_m_; }
    /// Whether the spot is in the square, at least `border` from its edge.
    [[nodiscard]] bool holds(Spot spot, double border) const;

    void move_to(Spot spot) const { cairo_move_to(context(), spot.x, spot.y); }
    void line_to(Spot spot) const { cairo_line_to(context(), spot.x, spot.y); }
    void stroke(const Colour& colour, double width) const;
    void fill(const Colour& colour) const;

    /// `anchor` is the share of the text to the left of the spot: 0, 0.5 or 1.
    void write(const std::string& text, Spot spot, double size, const Colour& colour,
               double anchor = 0.0, bool bold = false) const;
    /// Centres the text in both directions, with a pale rim so that it is legible on anything.
    void write_label(const std::string& text, Spot spot, double size) const;

  private:
    Page& page_;
    Bounds bounds_;
    double units_per_m_;
    double ring_m_;
};

}  // namespace scipd::tools
