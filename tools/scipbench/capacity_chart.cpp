// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/capacity_chart.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <stdexcept>

#include "tools/local_time.h"
#include "tools/scipbench/capacity_report.h"
#include "tools/scipbench/plot_area.h"

namespace scipd::tools {
namespace {

struct Curve {
    std::string name;
    Colour colour;
    std::function<double(const CapacityRun&)> share;
};

std::vector<CapacityRun> by_number(std::vector<CapacityRun> runs) {
    std::erase_if(runs, [](const CapacityRun& run) { return !run.failure.empty(); });
    std::ranges::stable_sort(runs, {}, &CapacityRun::scanners);
    return runs;
}

// The line leads through the numbers that hold.
void draw_curve(PlotArea& area, const Curve& curve, const std::vector<CapacityRun>& runs) {
    constexpr double width = 2.5;
    std::vector<Place> line;
    for (const CapacityRun& run : runs) {
        const Place place{static_cast<double>(run.scanners), curve.share(run)};
        area.dot(place, run.holds() ? curve.colour : colours::faint_ink, run.holds() ? 4.0 : 2.5);
        if (run.holds()) line.push_back(place);
    }
    area.line(line, curve.colour, width, false);
    area.legend(curve.name, curve.colour, width, false);
}

}  // namespace

void draw_capacity(const std::vector<CapacityRun>& runs, const StageCosts& costs,
                   const std::string& title, const std::string& machine,
                   const std::filesystem::path& file) {
    const std::vector<Curve> curves{
        {"all of scipd", colours::wall,
         [](const CapacityRun& run) { return share_of_all(run.scipd_use); }},
        {"the reader, which takes all scans", colours::scanner,
         [](const CapacityRun& run) { return share_of_all(run.reader_use); }},
        {"the casts of these scans alone, measured without scipd", colours::ink,
         [&](const CapacityRun& run) { return bare_share(run, costs); }}};
    const std::vector<CapacityRun> sorted = by_number(runs);
    if (sorted.empty()) return;
    Page page(file, PlotArea::page_height(curves.size() + 1));
    PlotArea area(page, {0.0, 1.05 * sorted.back().scanners, false}, {0.0, 1.0, false});
    area.title(title, machine + "; " + local_time(std::chrono::system_clock::now()));
    area.grid("scanners", "share of all cores");
    for (const Curve& curve : curves)
        draw_curve(area, curve, sorted);
    area.legend_of_dot("scans were lost, or came ever later", colours::faint_ink, 2.5);
    if (const auto why = page.finish()) throw std::runtime_error(file.string() + ": " + *why);
}

}  // namespace scipd::tools
