// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/terminal_plot.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <sstream>

#include "sim/text/quote.h"
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

/// In the cube of six by six by six colours.
int terminal_colour(const Colour& colour) {
    constexpr int first = 16;
    constexpr int levels = 6;
    const auto level = [](double part) { return static_cast<int>(std::lround(part * 5.0)); };
    return first + level(colour.red) * levels * levels + level(colour.green) * levels +
           level(colour.blue);
}

void draw(const TopView& view, const Colouring& colouring, const Projection& projection,
          BrailleCanvas& canvas) {
    const bool coloured = !colouring.legend.title.empty();
    const auto choose = [&](const PointStyle& style) {
        if (coloured) canvas.choose(terminal_colour(style.colour));
    };
    Dot before{};
    for (std::size_t i = 0; i < view.points.size(); ++i) {
        const ViewPoint& point = view.points[i];
        const Dot here = projection(point.x_m, point.y_m);
        const Dot from = point.joined ? before : here;
        choose(colouring.points[i]);
        canvas.line(from.x, from.y, here.x, here.y);
        before = here;
    }
    for (std::size_t i = 0; i < view.further.size(); ++i) {
        const Dot here = projection(view.further[i].x_m, view.further[i].y_m);
        choose(colouring.further[i]);
        canvas.mark(here.x, here.y, view.further[i].echo == 1 ? "○" : "×");
    }
    canvas.choose(std::nullopt);
    const Dot scanner = projection(0.0, 0.0);
    canvas.mark(scanner.x, scanner.y, "▲");
}

/// How many places a text takes that has no control characters.
int width_of(const std::string& text) {
    return static_cast<int>(std::ranges::count_if(
        text, [](char part) { return (static_cast<unsigned char>(part) & 0xC0U) != 0x80U; }));
}

/// As many names in a line as there is room for, and no more lines than `most`.
std::string names_text(const std::vector<Legend::Name>& names, int columns, int most) {
    constexpr int of_mark = 2;
    constexpr int of_more = 14;
    std::string text;
    int line = 1;
    int used = 0;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string name = sim::shown(names[i].text);
        const int wanted = width_of(name) + of_mark;
        const int left = columns - used - (line == most && i + 1 < names.size() ? of_more : 0);
        if (used > 0 && wanted + 2 > left) {
            if (line == most) return text + "  and " + std::to_string(names.size() - i) + " more\n";
            text += '\n';
            ++line;
            used = 0;
        }
        text += (used > 0 ? "  " : "") + in_colour(terminal_colour(names[i].style.colour), "⣿") +
                " " + name;
        used += wanted + (used > 0 ? 2 : 0);
    }
    return names.empty() ? text : text + '\n';
}

/// A line for a scale, or some for names.
std::string legend_text(const TopView& view, const Legend& legend, TerminalSize size) {
    std::string text;
    if (!legend.scale.empty()) {
        text += legend.title + ": " + legend.least + " ";
        for (const Colour& colour : legend.scale)
            text += in_colour(terminal_colour(colour), "█");
        text += " " + legend.most + "\n";
    }
    // With the other lines they leave two thirds of 24 rows to the plot.
    const int most = size.rows / 8 - (view.further.empty() ? 0 : 1);
    text += names_text(legend.names, size.columns, std::max(most, 1));
    if (!view.further.empty()) text += "○ second echo  × third echo\n";
    return text;
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

std::string terminal_plot(const TopView& view, const Colouring& colouring, const PlotText& text,
                          TerminalSize size) {
    const std::string legend = legend_text(view, colouring.legend, size);
    const int lines_of_text = 5 + static_cast<int>(std::ranges::count(legend, '\n'));
    constexpr int least_rows = 4;
    constexpr double cell_height = 2.0;  // in widths of a cell
    const double shape = view.bounds.width_m() / view.bounds.height_m() * cell_height;
    const int most_rows = std::max(size.rows - lines_of_text, least_rows);
    const int wanted_rows = static_cast<int>(std::ceil(size.columns / shape));
    const int rows = std::clamp(wanted_rows, least_rows, most_rows);
    const int columns = std::min(size.columns, static_cast<int>(std::ceil(rows * shape)));
    BrailleCanvas canvas(std::max(columns, 1), rows);
    const Projection projection(view.bounds, canvas);
    draw(view, colouring, projection, canvas);

    std::ostringstream out;
    out << sim::shown(text.title) << "\n";
    for (const std::string& line : canvas.lines())
        out << line << '\n';
    out << scale_bar(projection.dots_per_m(), columns) << '\n'
        << legend << sim::shown(text.scanner) << '\n'
        << sim::shown(text.scan) << '\n';
    return out.str();
}

}  // namespace scipd::tools
