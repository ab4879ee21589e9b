// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A plot in a terminal: how it shares the screen with the words around it.
#include "tools/scipcat/terminal_plot.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scipd::tools {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Hits all around, 5 m away.
TopView round_room() {
    TopView view;
    for (int i = 0; i < 100; ++i) {
        const double angle_rad = 0.0628 * i;
        view.points.push_back(
            {.x_m = 5.0 * std::cos(angle_rad), .y_m = 5.0 * std::sin(angle_rad), .range_m = 5.0});
        view.bounds.include(view.points.back().x_m, view.points.back().y_m);
    }
    return view;
}

Colouring of_materials(const TopView& view, int count) {
    Colouring colouring{std::vector<PointStyle>(view.points.size()), {}, {.title = "material"}};
    for (int i = 0; i < count; ++i)
        colouring.legend.names.push_back({"material_number_" + std::to_string(i), {}});
    return colouring;
}

/// Without colours.
std::vector<std::string> lines_of(const std::string& plot) {
    std::string plain;
    for (std::size_t i = 0; i < plot.size(); ++i) {
        if (plot[i] != '\x1b') {
            plain += plot[i];
        } else {
            i = plot.find('m', i);
        }
    }
    std::vector<std::string> lines;
    std::istringstream in(plain);
    for (std::string line; std::getline(in, line);)
        lines.push_back(line);
    return lines;
}

int characters(const std::string& line) {
    return static_cast<int>(std::ranges::count_if(
        line, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

TEST(TopView, HasNoPointOfACodeInMetres) {
    sim::RecordedScan scan{.ranges = {1.0, 0.006, 0.0, 65.533, std::nan(""), INFINITY, 2.0}};
    scan.directions = {.first_rad = 0.0, .increment_rad = 0.1};
    scan.unit = sim::RangeUnit::metres;
    for (const sim::ScannerIdentity& identity :
         {sim::ScannerIdentity{}, sim::ScannerIdentity{.min_range_m = 0.02, .max_range_m = 30.0}}) {
        const TopView view = make_top_view(scan, identity);
        ASSERT_EQ(view.points.size(), 2U);
        EXPECT_EQ(view.points[0].range_m, 1.0);
        EXPECT_EQ(view.points[1].range_m, 2.0);
        EXPECT_FALSE(view.points[1].adjacent);
    }
}

struct Seen {
    int rows;
    std::string all;
};

/// The rows of the plot stand between the title and the scale.
Seen drawn(int materials, TerminalSize size) {
    const TopView view = round_room();
    const std::string plot =
        terminal_plot(view, of_materials(view, materials), {"UST-10LX", "scanner", "scan"}, size);
    const auto lines = lines_of(plot);
    // The last line of the screen is the prompt's.
    EXPECT_LT(lines.size(), static_cast<std::size_t>(size.rows)) << plot;
    const auto scale =
        std::ranges::find_if(lines, [](const auto& line) { return line.starts_with("├"); });
    for (auto line = scale; line != lines.end(); ++line)
        EXPECT_LE(characters(*line), size.columns) << *line;
    return {static_cast<int>(scale - lines.begin()) - 1, plot};
}

TEST(TerminalPlot, KeepsTwoThirdsOfTheScreenHoweverManyMaterialsThereAre) {
    for (const int materials : {0, 1, 5, 12, 40, 1000})
        EXPECT_GE(drawn(materials, {80, 24}).rows, 16) << materials;
}

TEST(TerminalPlot, NamesAllMaterialsForWhichThereIsRoom) {
    const std::string some = drawn(9, {80, 24}).all;
    for (int i = 0; i < 9; ++i)
        EXPECT_THAT(some, HasSubstr("material_number_" + std::to_string(i)));
    EXPECT_THAT(some, Not(HasSubstr("more")));
    const std::string many = drawn(40, {80, 24}).all;
    EXPECT_THAT(many, HasSubstr("material_number_7"));
    EXPECT_THAT(many, HasSubstr(" more\n"));
    EXPECT_THAT(many, Not(HasSubstr("material_number_39")));
    EXPECT_THAT(drawn(40, {80, 120}).all, HasSubstr("material_number_39"));
}

}  // namespace
}  // namespace scipd::tools
