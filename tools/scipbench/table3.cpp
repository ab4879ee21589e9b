// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/table3.h"

#include <iomanip>
#include <ostream>
#include <span>
#include <string>

#include "sim/backends/registry.h"
#include "tools/scipbench/free_poses.h"
#include "tools/scipbench/paper.h"
#include "tools/scipbench/pixel_scan.h"

namespace scipd::tools {
namespace {

using Costs = std::array<double, resolutions>;

Table3Row measure_row(Contest& contest, const Resolution& resolution,
                      const std::vector<sim::Pose>& poses) {
    std::array<std::vector<double>, method_count> ms;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        for (std::size_t k = 0; k < method_count; ++k) {
            const auto method = static_cast<Method>(k);
            if (!contest.takes_part(method)) continue;
            // Each method scans at another pose, since the second one at the same pose would find
            // warm caches.
            const sim::Pose& pose = poses[(i + 17 * k) % poses.size()];
            ms[k].push_back(milliseconds_for([&] { contest.scan(method, pose); }));
        }
    }
    Table3Row row{resolution, {}};
    for (std::size_t k = 0; k < method_count; ++k) {
        if (!ms[k].empty()) row.all_ms[k] = spread_of(std::move(ms[k]));
    }
    return row;
}

/// The resolution from which on the depth buffer is always the faster.
std::string break_even(const Costs& rays_ms, const Costs& depth_ms) {
    std::size_t first = resolutions;
    while (first > 0 && depth_ms[first - 1] < rays_ms[first - 1])
        --first;
    if (first == resolutions) return "nowhere";
    const Resolution& resolution = paper_resolutions()[first];
    return "from " + resolution.name() + " on (" + std::to_string(resolution.rays()) + " rays)";
}

std::string break_even(const std::vector<Table3Row>& rows, Method depth) {
    if (!rows.front().ms(depth)) return "-";
    Costs rays_ms{};
    Costs depth_ms{};
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rays_ms[i] = rows[i].ms(Method::rays_with_material)->median;
        depth_ms[i] = rows[i].ms(depth)->median;
    }
    return break_even(rays_ms, depth_ms);
}

void print_break_even(const std::vector<Table3Row>& rows, std::ostream& out) {
    out << "the depth buffer is faster than rays, with material\n"
        << "  pixels as they are (ZBwM)        " << break_even(rows, Method::depth_with_material)
        << "\n"
        << "  with edges decided (exact)       " << break_even(rows, Method::exact) << "\n";
    for (const PaperComputer& computer : paper_computers) {
        out << "  the paper's computer " << computer.name[0] << "           "
            << break_even(computer.rays_with_material_ms, computer.depth_with_material_ms) << "\n";
    }
}

}  // namespace

std::vector<Table3Row> measure_table3(const sim::SharedScene& scene, int repetitions,
                                      double height_m, bool draws) {
    const auto rays = sim::preferred_backend().make(scene, {});
    const auto depth = draws ? sim::drawing_backend().make(scene, {}) : nullptr;
    const auto poses = free_poses(*rays, static_cast<std::size_t>(repetitions), height_m);
    std::vector<Table3Row> rows;
    for (const Resolution& resolution : paper_resolutions()) {
        Contest contest(scene, *rays, depth.get(), resolution);
        measure_row(contest, resolution, {poses.front(), poses.back()});  // only warms up
        rows.push_back(measure_row(contest, resolution, poses));
    }
    return rows;
}

void print_table3(const std::vector<Table3Row>& rows, std::ostream& out) {
    out << "one scan in ms: median, and +- half of what eight of ten lie within\n\n"
        << std::left << std::setw(8) << "" << std::right;
    for (const char* method : method_names)
        out << std::setw(22) << method;
    out << "\n";
    for (const Table3Row& row : rows) {
        out << std::left << std::setw(8) << row.resolution.name() << std::right;
        for (const std::optional<Spread>& ms : row.all_ms) {
            if (!ms) {
                out << std::setw(22) << "-";
                continue;
            }
            out << std::setw(10) << significant(ms->median, 3) << " +-" << std::setw(9)
                << significant(0.5 * (ms->high - ms->low), 2);
        }
        out << "\n";
    }
    out << "\n";
    print_break_even(rows, out);
}

void write_table3_csv(const std::vector<Table3Row>& rows, std::ostream& out) {
    out << "resolution,rays";
    for (const std::string method : method_names)
        out << "," << method << "_ms," << method << "_p10_ms," << method << "_p90_ms";
    out << "\n";
    for (const Table3Row& row : rows) {
        out << row.resolution.name() << "," << row.resolution.rays();
        for (const std::optional<Spread>& ms : row.all_ms) {
            if (!ms) {
                out << ",,,";
                continue;
            }
            out << "," << ms->median << "," << ms->low << "," << ms->high;
        }
        out << "\n";
    }
}

std::vector<Table4Row> measure_table4(const sim::SharedScene& scene, int repetitions,
                                      double height_m) {
    const auto rays = sim::preferred_backend().make(scene, {});
    const auto poses = free_poses(*rays, static_cast<std::size_t>(repetitions), height_m);
    std::vector<Table4Row> rows;
    for (const Resolution& resolution : paper_resolutions()) {
        PixelScan pixels(scene, resolution.strip());
        std::vector<double> depth_ms;
        std::vector<double> triangles_ms;
        for (const sim::Pose& pose : poses) {
            pixels.draw(pose);
            depth_ms.push_back(milliseconds_for([&] { pixels.read_depth(); }));
            triangles_ms.push_back(milliseconds_for([&] { pixels.read_triangles(); }));
        }
        rows.push_back({resolution, spread_of(depth_ms), spread_of(triangles_ms)});
    }
    return rows;
}

void print_table4(const std::vector<Table4Row>& rows, std::ostream& out) {
    out << "reading back in ms: median, and +- half of what eight of ten lie within;\n"
           "depth and frame buffer of the paper's computers A, B and C beside it\n\n"
        << std::left << std::setw(8) << "" << std::right << std::setw(22) << "depth"
        << std::setw(22) << "triangle numbers";
    for (const char* column : {"A depth", "frame", "B depth", "frame", "C depth", "frame"})
        out << std::setw(9) << column;
    out << "\n" << std::fixed << std::setprecision(3);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        out << std::left << std::setw(8) << rows[i].resolution.name() << std::right;
        for (const Spread& ms : {rows[i].depth_ms, rows[i].triangles_ms}) {
            out << std::setw(10) << significant(ms.median, 3) << " +-" << std::setw(9)
                << significant(0.5 * (ms.high - ms.low), 2);
        }
        for (const PaperComputer& computer : paper_computers)
            out << std::setw(9) << computer.read_depth_ms[i] << std::setw(9)
                << computer.read_frame_ms[i];
        out << "\n";
    }
}

void write_table4_csv(const std::vector<Table4Row>& rows, std::ostream& out) {
    out << "resolution,pixels,depth_ms,depth_p10_ms,depth_p90_ms,triangles_ms,triangles_p10_ms,"
           "triangles_p90_ms\n";
    for (const Table4Row& row : rows) {
        out << row.resolution.name() << "," << row.resolution.rays();
        for (const Spread& ms : {row.depth_ms, row.triangles_ms})
            out << "," << ms.median << "," << ms.low << "," << ms.high;
        out << "\n";
    }
}

}  // namespace scipd::tools
