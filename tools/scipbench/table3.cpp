// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/table3.h"

#include <iomanip>
#include <ostream>
#include <string>

#include "sim/backends/registry.h"
#include "tools/scipbench/free_poses.h"
#include "tools/scipbench/pixel_scan.h"

namespace scipd::tools {
namespace {

constexpr double robot_height_m = 0.3;

/// Everything that the five methods need at one resolution.
class Contest {
  public:
    Contest(const sim::SharedScene& scene, sim::RangeBackend& rays, sim::RangeBackend& depth,
            const Resolution& resolution)
        : rays_(rays),
          depth_(depth),
          pixels_(scene, resolution.strip()),
          directions_(resolution.directions()),
          hits_(directions_.size()),
          range_m_(directions_.size()),
          materials_(directions_.size()) {}

    void cast_rays(const sim::Pose& pose, bool with_material) {
        rays_.cast({directions_, {&pose, 1}}, hits_);
        for (std::size_t i = 0; i < hits_.size(); ++i)
            range_m_[i] = hits_[i].range_m;
        if (!with_material) return;
        for (std::size_t i = 0; i < hits_.size(); ++i)
            materials_[i] = hits_[i].material;
    }
    void draw(const sim::Pose& pose, bool with_material) {
        pixels_.draw(pose);
        pixels_.read_depth();
        pixels_.find_ranges(range_m_);
        if (!with_material) return;
        pixels_.read_triangles();
        pixels_.find_materials(materials_);
    }
    void cast_depth(const sim::Pose& pose) { depth_.cast({directions_, {&pose, 1}}, hits_); }

  private:
    sim::RangeBackend& rays_;
    sim::RangeBackend& depth_;
    PixelScan pixels_;
    std::vector<glm::vec3> directions_;
    std::vector<sim::Hit> hits_;
    std::vector<float> range_m_;
    std::vector<sim::MaterialId> materials_;
};

Table3Row measure_row(Contest& contest, const Resolution& resolution,
                      const std::vector<sim::Pose>& poses) {
    std::array<std::vector<double>, methods.size()> ms;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        // Not all at the same place: who comes second to it finds the processor prepared.
        const auto pose = [&](std::size_t method) -> const sim::Pose& {
            return poses[(i + 17 * method) % poses.size()];
        };
        ms[0].push_back(milliseconds_for([&] { contest.cast_rays(pose(0), false); }));
        ms[1].push_back(milliseconds_for([&] { contest.cast_rays(pose(1), true); }));
        ms[2].push_back(milliseconds_for([&] { contest.draw(pose(2), false); }));
        ms[3].push_back(milliseconds_for([&] { contest.draw(pose(3), true); }));
        ms[4].push_back(milliseconds_for([&] { contest.cast_depth(pose(4)); }));
    }
    Table3Row row{resolution, {}};
    for (std::size_t method = 0; method < methods.size(); ++method)
        row.ms[method] = spread_of(std::move(ms[method]));
    return row;
}

std::string break_even(const std::vector<Table3Row>& rows) {
    constexpr std::size_t rays = 1;
    constexpr std::size_t depth = 3;
    for (const Table3Row& row : rows) {
        if (row.ms[depth].median < row.ms[rays].median)
            return "from " + row.resolution.name() + " on the depth buffer is faster";
    }
    return "rays are faster at every resolution";
}

}  // namespace

std::vector<Table3Row> measure_table3(const sim::SharedScene& scene, int repetitions) {
    const auto rays = sim::make_backend("embree", scene);
    const auto depth = sim::make_backend("depth", scene);
    const auto poses = free_poses(*rays, static_cast<std::size_t>(repetitions), robot_height_m);
    std::vector<Table3Row> rows;
    for (const Resolution& resolution : paper_resolutions()) {
        Contest contest(scene, *rays, *depth, resolution);
        measure_row(contest, resolution, {poses.front(), poses.back()});  // warms up
        rows.push_back(measure_row(contest, resolution, poses));
    }
    return rows;
}

void print_table3(const std::vector<Table3Row>& rows, std::ostream& out) {
    out << "one scan in ms: median, and +- half of what eight of ten lie within\n\n"
        << std::left << std::setw(10) << "" << std::right;
    for (const char* method : methods)
        out << std::setw(18) << method;
    out << "\n" << std::fixed;
    for (const Table3Row& row : rows) {
        out << std::left << std::setw(10) << row.resolution.name() << std::right;
        for (const Spread& ms : row.ms) {
            out << std::setw(10) << std::setprecision(4) << ms.median << " +-" << std::setw(5)
                << std::setprecision(2) << 0.5 * (ms.high - ms.low);
        }
        out << "\n";
    }
    out << "\n" << break_even(rows) << "\n";
}

void write_table3_csv(const std::vector<Table3Row>& rows, std::ostream& out) {
    out << "resolution,rays";
    for (const std::string method : methods)
        out << "," << method << "_ms," << method << "_p10_ms," << method << "_p90_ms";
    out << "\n";
    for (const Table3Row& row : rows) {
        out << row.resolution.name() << "," << row.resolution.rays();
        for (const Spread& ms : row.ms)
            out << "," << ms.median << "," << ms.low << "," << ms.high;
        out << "\n";
    }
}

}  // namespace scipd::tools
