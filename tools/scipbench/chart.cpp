// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/chart.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <limits>
#include <stdexcept>

#include "tools/local_time.h"
#include "tools/scipbench/paper.h"
#include "tools/scipbench/plot_area.h"

namespace scipd::tools {
namespace {

constexpr std::array<Colour, 3> paper_colours{
    {{0.80, 0.55, 0.15}, {0.45, 0.62, 0.25}, {0.62, 0.42, 0.68}}};

/// How large a mark is where the depth backend is so far off.
struct MarkSize {
    double least_m;
    double radius;
    const char* words;
};
constexpr std::array<MarkSize, 3> mark_sizes{
    {{0.1, 4.0, "the depth backend is off by more than 10 cm"},
     {0.01, 3.0, "by more than 1 cm"},
     {0.001, 2.0, "by more than 1 mm"}}};

std::string time_now() {
    return local_time(std::chrono::system_clock::now());
}

void finish(Page& page, const std::filesystem::path& file) {
    if (const auto why = page.finish()) throw std::runtime_error(file.string() + ": " + *why);
}

void draw_paper(PlotArea& area, const std::vector<Table3Row>& rows) {
    for (std::size_t k = 0; k < paper_computers.size(); ++k) {
        const PaperComputer& computer = paper_computers[k];
        std::vector<Place> rays;
        std::vector<Place> depth;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const double count = rows[i].resolution.rays();
            rays.push_back({count, computer.rays_with_material_ms[i]});
            depth.push_back({count, computer.depth_with_material_ms[i]});
        }
        area.line(rays, paper_colours[k], 1.5, true);
        area.line(depth, paper_colours[k], 1.5, false);
        area.legend(std::string("rays, ") + computer.name, paper_colours[k], 1.5, true);
        area.legend(std::string("depth buffer, ") + computer.name, paper_colours[k], 1.5, false);
    }
}

using Axis = double glm::dvec3::*;

AxisRange around(const ComparedScans& scans, Axis axis) {
    AxisRange range{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest(),
                    false};
    for (const glm::dvec3& hit : scans.hits_m) {
        range.low = std::min(range.low, hit.*axis);
        range.high = std::max(range.high, hit.*axis);
    }
    return range;
}

void widen(AxisRange& range, double length) {
    const double middle = 0.5 * (range.low + range.high);
    range.low = middle - 0.5 * length;
    range.high = middle + 0.5 * length;
}

/// Gives both axes the same scale, with a little room around the data.
void equalise(AxisRange& x, AxisRange& y) {
    const double width = 1.05 * std::max(x.high - x.low, (y.high - y.low) * PlotArea::aspect());
    widen(x, width);
    widen(y, width / PlotArea::aspect());
}

}  // namespace

void draw_table3(const std::vector<Table3Row>& rows, const std::string& machine,
                 const std::filesystem::path& file) {
    constexpr std::array shown{Method::rays_with_material, Method::depth_with_material,
                               Method::exact};
    Page page(file, PlotArea::page_height(shown.size() + 2 * paper_computers.size()));
    PlotArea area(page, {1.0, 1e5, true}, {1e-4, 1e3, true});
    area.title("What one scan costs, with the material of each hit",
               machine + "; A, B, C: the laptops of the paper; " + time_now());
    area.grid("rays", "ms");
    constexpr std::array<Colour, 3> inks{colours::wall, colours::wall, colours::scanner};
    constexpr std::array words{"rays", "depth buffer", "depth buffer, edges decided"};
    for (std::size_t k = 0; k < shown.size(); ++k) {
        if (!rows.front().ms(shown[k])) continue;
        std::vector<Place> values;
        for (const Table3Row& row : rows)
            values.push_back({double(row.resolution.rays()), row.ms(shown[k])->median});
        const bool rays = k == 0;
        area.line(values, inks[k], 3.0, rays);
        area.legend(std::string(words[k]) + ", this machine", inks[k], 3.0, rays);
    }
    draw_paper(area, rows);
    finish(page, file);
}

void draw_differences(const ComparedScans& scans, const std::string& title,
                      const std::filesystem::path& file) {
    Page page(file, PlotArea::page_height(1 + mark_sizes.size()));
    AxisRange x = around(scans, &glm::dvec3::x);
    AxisRange y = around(scans, &glm::dvec3::y);
    equalise(x, y);
    PlotArea area(page, x, y);
    area.title(title, "from above; " + time_now());
    area.grid("x in m", "y in m");
    for (const glm::dvec3& hit : scans.hits_m)
        area.dot({hit.x, hit.y}, colours::joint, 0.6);
    for (const Difference& difference : scans.differences) {
        const std::size_t size = difference.off_m > mark_sizes[0].least_m   ? 0
                                 : difference.off_m > mark_sizes[1].least_m ? 1
                                                                            : 2;
        area.dot({difference.place_m.x, difference.place_m.y}, colours::scanner,
                 mark_sizes[size].radius);
    }
    area.legend_of_dot("what the rays hit", colours::joint, 2.0);
    for (const MarkSize& each : mark_sizes)
        area.legend_of_dot(each.words, colours::scanner, each.radius);
    finish(page, file);
}

}  // namespace scipd::tools
