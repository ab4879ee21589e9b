// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A picture of dots in a terminal: a character of Unicode's Braille block holds two by four of
// them, about as far apart across as down.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace scipd::tools {

class BrailleCanvas {
  public:
    static constexpr int dots_across = 2;
    static constexpr int dots_down = 4;

    BrailleCanvas(int columns, int rows);

    [[nodiscard]] int width() const { return columns_ * dots_across; }
    [[nodiscard]] int height() const { return rows_ * dots_down; }

    /// Dots outside are left out.
    void dot(int x, int y);
    void line(int x0, int y0, int x1, int y1);
    /// A character of its own in place of the cell that holds this dot.
    void mark(int x, int y, std::string_view character);

    /// Without what is blank at the ends of lines.
    [[nodiscard]] std::vector<std::string> lines() const;

  private:
    struct Cell {
        unsigned dots = 0;
        std::string mark;
    };
    [[nodiscard]] bool inside(int x, int y) const;
    [[nodiscard]] Cell& cell(int x, int y);

    int columns_;
    int rows_;
    std::vector<Cell> cells_;
};

}  // namespace scipd::tools
