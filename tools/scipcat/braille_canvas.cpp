// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/braille_canvas.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <utility>

namespace scipd::tools {
namespace {

/// The bit of each dot in Unicode's order, in rows of two.
constexpr std::array<std::array<unsigned, 2>, 4> bits{
    {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}}};

/// The character U+2800 plus the bits, in UTF-8.
std::string braille(unsigned dots) {
    return {'\xE2', static_cast<char>(0xA0U | dots >> 6U),
            static_cast<char>(0x80U | (dots & 0x3FU))};
}

}  // namespace

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

}  // namespace scipd::tools
