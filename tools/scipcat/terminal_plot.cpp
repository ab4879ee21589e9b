// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/terminal_plot.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "tools/scipcat/braille_canvas.h"

namespace scipd::tools {
namespace {

struct Dot {
    int x;
    int y;
};

/// Maps places to dots: forward is up, left is left.
class Projection {
  public:
    Projection(const Bounds& bounds, const BrailleCanvas& canvas)
        : bounds_(bounds),
          dots_per_m_(std::min((canvas.width() - 1) / bounds.width_m(),
                               (canvas.height() - 1) / bounds.height_m())) {}

    [[nodiscard]] double dots_per_m() const { return dots_per_m_; }
    [[nodiscard]] Dot operator()(double x_m, double y_m) const {
        return {static_cast<int>(std::lround((bounds_.max_y_m - y_m) * dots_per_m_)),
                static_cast<int>(std::lround((bounds_.max_x_m - x_m) * dots_per_m_))};
    }

  private:
    Bounds bounds_;
    double dots_per_m_;
};

void draw(const TopView& view, const Projection& projection, BrailleCanvas& canvas) {
    Dot before{};
    for (const ViewPoint& point : view.points) {
        const Dot here = projection(point.x_m, point.y_m);
        const Dot from = point.joined ? before : here;
        canvas.line(from.x, from.y, here.x, here.y);
        before = here;
    }
    const Dot scanner = projection(0.0, 0.0);
    canvas.mark(scanner.x, scanner.y, "▲");
}

std::string scale_bar(double dots_per_m, int columns) {
    const double columns_per_m = dots_per_m / BrailleCanvas::dots_across;
    const double longest_m = columns / 3.0 / columns_per_m;
    const double length_m = round_step_m(longest_m / 2.5, 1.0);
    const int length = std::max(1, static_cast<int>(std::lround(length_m * columns_per_m)));
    std::ostringstream text;
    text << "├";
    for (int i = 1; i < length; ++i)
        text << "─";
    text << "┤ " << length_m << " m";
    return text.str();
}

}  // namespace

std::string terminal_plot(const TopView& view, const PlotText& text, TerminalSize size) {
    constexpr int lines_of_text = 5;
    constexpr int least_rows = 4;
    constexpr double cell_height = 2.0;  // in widths of a cell
    const double shape = view.bounds.width_m() / view.bounds.height_m() * cell_height;
    const int most_rows = std::max(size.rows - lines_of_text, least_rows);
    const int wanted_rows = static_cast<int>(std::ceil(size.columns / shape));
    const int rows = std::clamp(wanted_rows, least_rows, most_rows);
    const int columns = std::min(size.columns, static_cast<int>(std::ceil(rows * shape)));
    BrailleCanvas canvas(std::max(columns, 1), rows);
    const Projection projection(view.bounds, canvas);
    draw(view, projection, canvas);

    std::ostringstream out;
    out << text.title << "\n";
    for (const std::string& line : canvas.lines())
        out << line << '\n';
    out << scale_bar(projection.dots_per_m(), columns) << '\n'
        << text.scanner << '\n'
        << text.scan << '\n';
    return out.str();
}

}  // namespace scipd::tools
