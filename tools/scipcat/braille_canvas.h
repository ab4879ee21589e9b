// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A picture of dots for a terminal. A character of Unicode's Braille block holds two by four dots,
// which are about as far apart across as down.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scipd::tools {

/// The text as a terminal shows it in that colour.
[[nodiscard]] std::string in_colour(std::optional<int> colour, const std::string& text);

class BrailleCanvas {
  public:
    static constexpr int dots_across = 2;
    static constexpr int dots_down = 4;

    BrailleCanvas(int columns, int rows);

    [[nodiscard]] int width() const { return columns_ * dots_across; }
    [[nodiscard]] int height() const { return rows_ * dots_down; }

    /// What follows has this colour, one of the 256 that terminals have. A cell has the colour of
    /// what came last.
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

}  // namespace scipd::tools
