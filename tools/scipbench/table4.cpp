// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/table4.h"

#include <iomanip>
#include <ostream>

#include "sim/backends/registry.h"
#include "tools/scipbench/free_poses.h"
#include "tools/scipbench/paper.h"
#include "tools/scipbench/pixel_scan.h"

namespace scipd::tools {
namespace {

constexpr double robot_height_m = 0.3;

}  // namespace

std::vector<Table4Row> measure_table4(const sim::SharedScene& scene, int repetitions) {
    const auto rays = sim::make_backend("embree", scene);
    const auto poses = free_poses(*rays, static_cast<std::size_t>(repetitions), robot_height_m);
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
    out << "reading back in ms, median; A, B and C are the paper's computers\n\n"
        << std::left << std::setw(10) << "" << std::right << std::setw(10) << "depth"
        << std::setw(10) << "numbers";
    for (const char* computer : {"A", "B", "C"}) {
        out << std::setw(9) << computer << " depth" << std::setw(9) << computer << " frame";
    }
    out << "\n" << std::fixed;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        out << std::left << std::setw(10) << rows[i].resolution.name() << std::right
            << std::setprecision(4) << std::setw(10) << rows[i].depth_ms.median << std::setw(10)
            << rows[i].triangles_ms.median << std::setprecision(3);
        for (const PaperComputer& computer : paper_computers)
            out << std::setw(15) << computer.read_depth_ms[i] << std::setw(15)
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
