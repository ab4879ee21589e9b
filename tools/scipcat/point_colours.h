// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which colour each point of a view has, and the legend that explains it. The palettes are those
// that colour-blind people can read. Values; no thread rule.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/colours.h"
#include "tools/scipcat/top_view.h"

namespace scipd::tools {

enum class ColourBy { distance, intensity, material, error };

/// Materials that have the same colour differ by their shape.
enum class Shape { circle, square, triangle };

struct PointStyle {
    Colour colour = colours::wall;
    Shape shape = Shape::circle;
};

struct Legend {
    struct Name {
        std::string text;
        PointStyle style;
    };
    std::string title;          ///< empty: all points are alike
    std::vector<Colour> scale;  ///< from the least to the most; empty: there are names
    std::string least;
    std::string most;
    std::vector<Name> names;
};

struct Colouring {
    std::vector<PointStyle> points;   ///< as TopView has them
    std::vector<PointStyle> further;  ///< as TopView has them
    Legend legend;
};

/// Materials and errors are those that the points have been told.
[[nodiscard]] Colouring colour_points(const TopView& view, std::optional<ColourBy> by);

}  // namespace scipd::tools
