// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/measure_capacity.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "daemon/models/model_registry.h"
#include "tools/local_time.h"
#include "tools/output_file.h"
#include "tools/scipbench/capacity.h"
#include "tools/scipbench/capacity_report.h"
#include "tools/scipbench/capacity_run.h"
#include "tools/scipbench/capacity_stages.h"
#include "tools/scipbench/capacity_world.h"
#include "tools/scipbench/machine.h"
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

/// Draws what scipd and its reader use of all cores, over the number of scanners, and marks the
/// numbers that lose scans. Writes a PNG or an SVG, by the file's ending. Throws std::runtime_error
/// if it cannot write the file.
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

class Measurement {
  public:
    explicit Measurement(const CapacityQuestion& question)
        : question_(question), world_(question.setup.scene) {
        constexpr int enough = 64;
        const CapacitySetup& setup = question.setup;
        costs_ = measure_stages(world_.backend(), daemon::find_model(setup.model), setup.driving,
                                world_.places(enough));
    }

    void print() {
        std::cout << describe_machine() << "\n" << describe(question_.setup) << "\n\n";
        print_run_header(std::cout);
        if (question_.scanners) {
            print_all(told(run(*question_.scanners)));
        } else {
            search();
        }
        if (!question_.plot.empty()) {
            draw_capacity(runs_, costs_, describe(question_.setup), describe_machine(),
                          question_.plot);
        }
        write_to(question_.csv, [this](std::ostream& out) { write_runs_csv(runs_, costs_, out); });
    }

  private:
    const CapacityRun& run(int scanners) {
        runs_.push_back(
            run_scanners(question_.setup, world_.places(scanners + question_.setup.moving)));
        print_run(runs_.back(), costs_, std::cout);
        return runs_.back();
    }

    static const CapacityRun& told(const CapacityRun& run) {
        if (!run.failure.empty()) throw std::runtime_error(run.failure);
        return run;
    }

    // A neighbour of this machine may take a core away for a moment, so each number has two tries.
    bool holds(int scanners) { return run(scanners).holds() || run(scanners).holds(); }

    [[nodiscard]] const CapacityRun& last(int scanners) const {
        return *std::ranges::find(runs_.rbegin(), runs_.rend(), scanners, &CapacityRun::scanners);
    }

    void search() {
        constexpr int first_scanners = 16;
        const int limit = std::min(question_.most.value_or(world_.most()), world_.most());
        const Capacity found =
            find_capacity(first_scanners, limit, [this](int scanners) { return holds(scanners); });
        if (found.held == 0) (void)told(runs_.back());
        tell(found);
        if (found.held == 0) return;
        std::cout << "\n";
        print_costs(last(found.held), costs_, std::cout);
        std::cout << "\nat four fifths of them:\n";
        print_run_header(std::cout);
        const CapacityRun& calm = run(std::max(1, found.held * 4 / 5));
        std::cout << "\n";
        print_lateness(calm, std::cout);
    }

    void tell(const Capacity& found) const {
        std::cout << "\n" << found.held << " scanners keep up and lose no scan";
        if (found.too_many) {
            std::cout << ", " << *found.too_many
                      << " do not\nwhat limits: " << what_limits(last(*found.too_many)) << "\n";
        } else if (found.held == world_.most()) {
            std::cout << "\nwhat limits: descriptors; raise them with ulimit -Hn\n";
        } else {
            std::cout << "; no more were tried\n";
        }
    }

    void print_all(const CapacityRun& run) const {
        std::cout << "\n";
        print_costs(run, costs_, std::cout);
        std::cout << "\n";
        print_lateness(run, std::cout);
    }

    const CapacityQuestion& question_;
    CapacityWorld world_;
    StageCosts costs_;
    std::vector<CapacityRun> runs_;
};

}  // namespace

void measure_capacity(const CapacityQuestion& question) {
    Measurement(question).print();
}

}  // namespace scipd::tools
