// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/terminal_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/text/quote.h"

namespace scipd::tools {
namespace {

/// A picture of dots for a terminal. A character of Unicode's Braille block holds two by four dots,
/// which are about as far apart across as down.
class BrailleCanvas {
  public:
    static constexpr int dots_across = 2;
    static constexpr int dots_down = 4;

    BrailleCanvas(int columns, int rows);

    [[nodiscard]] int width() const { return columns_ * dots_across; }
    [[nodiscard]] int height() const { return rows_ * dots_down; }

    /// The colour of the dots that follow, one of the 256 of terminals. A cell has that of its last
    /// dot.
    void choose(std::optional<int> colour) { colour_ = colour; }

    /// Ignores dots outside the canvas.
    void dot(int x, int y);
    void line(int x0, int y0, int x1, int y1);
    /// Puts this character in the cell that holds the dot.
    void mark(int x, int y, std::string_view character);

    /// The lines, without trailing blanks.
    [[nodiscard]] std::vector<std::string> lines() const;

  private:
    struct Cell {
        unsigned dots = 0;
        std::string mark;
        std::optional<int> colour;
    };
    [[nodiscard]] bool inside(int x, int y) const;
    [[nodiscard]] Cell& cell(int x, int y);

    int columns_;
    int rows_;
    std::vector<Cell> cells_;
    std::optional<int> colour_;
};

/// The bit of each dot in Unicode's order, in rows of two.
constexpr std::array<std::array<unsigned, 2>, 4> bits{
    {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}}};

/// The character U+2800 plus the bits, in UTF-8.
std::string braille(unsigned dots) {
    return {'\xE2', static_cast<char>(0xA0U | dots >> 6U),
            static_cast<char>(0x80U | (dots & 0x3FU))};
}

/// The text as a terminal shows it in that colour.
std::string in_colour(std::optional<int> colour, const std::string& text) {
    if (!colour) return text;
    return "\x1b[38;5;" + std::to_string(*colour) + "m" + text + "\x1b[0m";
}

BrailleCanvas::BrailleCanvas(int columns, int rows)
    : columns_(columns), rows_(rows), cells_(static_cast<std::size_t>(columns * rows)) {}

void BrailleCanvas::dot(int x, int y) {
    if (!inside(x, y)) return;
    cell(x, y).dots |=
        bits[static_cast<std::size_t>(y % dots_down)][static_cast<std::size_t>(x % dots_across)];
    cell(x, y).colour = colour_;
}

void BrailleCanvas::line(int x0, int y0, int x1, int y1) {
    const int steps = std::max({std::abs(x1 - x0), std::abs(y1 - y0), 1});
    for (int i = 0; i <= steps; ++i)
        dot(x0 + (x1 - x0) * i / steps, y0 + (y1 - y0) * i / steps);
}

void BrailleCanvas::mark(int x, int y, std::string_view character) {
    if (!inside(x, y)) return;
    cell(x, y).mark = character;
    cell(x, y).colour = colour_;
}

std::vector<std::string> BrailleCanvas::lines() const {
    std::vector<std::string> text;
    for (int row = 0; row < rows_; ++row) {
        std::string line;
        std::size_t end = 0;
        for (int column = 0; column < columns_; ++column) {
            const Cell& here = cells_[static_cast<std::size_t>(row * columns_ + column)];
            const bool blank = here.dots == 0 && here.mark.empty();
            const std::string shown = here.mark.empty() ? braille(here.dots) : here.mark;
            line += blank ? " " : in_colour(here.colour, shown);
            if (!blank) end = line.size();
        }
        line.resize(end);
        text.push_back(std::move(line));
    }
    return text;
}

bool BrailleCanvas::inside(int x, int y) const {
    return x >= 0 && y >= 0 && x < width() && y < height();
}

BrailleCanvas::Cell& BrailleCanvas::cell(int x, int y) {
    return cells_[static_cast<std::size_t>(y / dots_down * columns_ + x / dots_across)];
}

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
