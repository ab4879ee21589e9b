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
