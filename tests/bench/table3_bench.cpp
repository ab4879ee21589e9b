// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Compares every cell of scipbench's table3, in the rescue maze, with a bare loop over the same
// library calls. Both run in turns:
//
//   R, RwM     rtcIntersect16 over the same two scenes: what stands still and what can move
//   ZB, ZBwM   draws the same picture and reads it back; it selects the visible triangles
//              beforehand, and computes nothing from what it reads
//   exact      as ZBwM; the depth backend in addition decides every beam exactly
//   whole      ZBwM again, compared with drawing the whole scene, which needs no selection
//
// Times are of batches of scans, so that reading the clock costs nothing beside them. The lower
// quartile of a batch's times counts, since other load on the machine only adds time.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <time.h>

#include "sim/backends/registry.h"
#include "sim/loaders/scene_file.h"
#include "tests/bench/bare_depth.h"
#include "tests/bench/bare_embree.h"
#include "tools/scipbench/contest.h"
#include "tools/scipbench/free_poses.h"

namespace scipd {
namespace {

using tools::Contest;
using tools::Method;

constexpr std::size_t poses_in_all = 64;
constexpr std::size_t batch = 16;
constexpr float any_range_m = std::numeric_limits<float>::infinity();

std::vector<std::vector<sim::Pose>> one_each(const std::vector<sim::Pose>& poses) {
    std::vector<std::vector<sim::Pose>> scans;
    for (const sim::Pose& pose : poses)
        scans.push_back({pose});
    return scans;
}

/// All that is measured at one resolution. A scan's number is the index of its pose.
class Row {
  public:
    Row(const sim::SharedScene& scene, sim::RangeBackend& rays, sim::RangeBackend& depth,
        const sim::BareEmbree& bare_rays, const tools::Resolution& resolution,
        const std::vector<sim::Pose>& poses)
        : poses_(poses),
          contest_(scene, rays, &depth, resolution),
          bare_rays_(bare_rays),
          directions_(resolution.directions()),
          range_m_(directions_.size()),
          materials_(directions_.size()),
          view_{sim::PlannedView{.strip = resolution.strip()}},
          bare_depth_(*scene, view_, view_[0].strip.size_px, one_each(poses),
                      sim::BareDepth::Drawn::seen),
          whole_(*scene, view_, view_[0].strip.size_px, one_each(poses),
                 sim::BareDepth::Drawn::whole) {}

    void scan(Method method, std::size_t i) { contest_.scan(method, poses_[i]); }

    void scan_bare(Method method, std::size_t i) {
        switch (method) {
            case Method::rays:
                return bare_rays_.cast(directions_, {&poses_[i], 1}, any_range_m, range_m_);
            case Method::rays_with_material:
                return bare_rays_.cast(directions_, {&poses_[i], 1}, any_range_m, range_m_,
                                       materials_);
            case Method::depth:
                bare_depth_.draw(i);
                return bare_depth_.read_depth();
            case Method::depth_with_material:
                bare_depth_.draw(i);
                bare_depth_.read_depth();
                return bare_depth_.read_triangles();
            case Method::exact:
                return bare_depth_.draw_and_read(i);
        }
    }
    void scan_whole(std::size_t i) {
        whole_.draw(i);
        whole_.read_depth();
        whole_.read_triangles();
    }

    /// Whether the yardsticks give the same ranges and materials.
    bool agree() {
        std::size_t others = 0;
        for (std::size_t i = 0; i < poses_.size(); ++i) {
            scan(Method::rays_with_material, i);
            scan_bare(Method::rays_with_material, i);
            for (std::size_t k = 0; k < range_m_.size(); ++k) {
                const float off_m = contest_.range_m()[k] - range_m_[k];
                if (contest_.range_m()[k] != range_m_[k] && !(std::abs(off_m) < 1e-3F))
                    return false;
            }
            // Where faces of two objects coincide, a ray may hit either first.
            for (std::size_t k = 0; k < materials_.size(); ++k)
                others += contest_.materials()[k] != materials_[k] ? 1 : 0;
        }
        return 1000 * others <= poses_.size() * materials_.size();
    }

  private:
    const std::vector<sim::Pose>& poses_;
    Contest contest_;
    const sim::BareEmbree& bare_rays_;
    std::vector<glm::vec3> directions_;
    std::vector<float> range_m_;
    std::vector<sim::MaterialId> materials_;
    std::array<sim::PlannedView, 1> view_;
    sim::BareDepth bare_depth_;
    sim::BareDepth whole_;
};

/// Measures the time of this thread if it waits for nothing, else the elapsed time.
class Stopwatch {
  public:
    explicit Stopwatch(bool nothing_is_waited_for)
        : clock_(nothing_is_waited_for ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC) {}

    template <typename Work>
    double seconds_for(Work work) const {
        const double begin_s = now_s();
        work();
        return now_s() - begin_s;
    }

  private:
    [[nodiscard]] double now_s() const {
        timespec now{};
        clock_gettime(clock_, &now);
        return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
    }

    clockid_t clock_;
};

struct Cell {
    double us;
    double ratio;
};

/// The time of a batch with little other load: the lower quartile of its times.
double quiet(std::vector<double> times_s) {
    const auto quarter = times_s.begin() + static_cast<std::ptrdiff_t>(times_s.size() / 4);
    std::ranges::nth_element(times_s, quarter);
    return *quarter;
}

/// Runs `measured` and `bare` in turn, a batch each, never both at the same poses.
template <typename Measured, typename Bare>
Cell compare(int rounds, Measured measured, Bare bare) {
    constexpr std::size_t batches = poses_in_all / batch;
    std::array<std::vector<double>, batches> measured_s;
    std::array<std::vector<double>, batches> bare_s;
    const Stopwatch watch(sim::depth_context()->description().software());
    const auto seconds_of = [&](std::size_t at, auto scan) {
        return watch.seconds_for([&] {
            for (std::size_t i = batch * at; i < batch * (at + 1); ++i)
                scan(i);
        });
    };
    for (int round = -1; round < rounds; ++round) {
        for (std::size_t at = 0; at < batches; ++at) {
            const std::size_t other = (at + batches / 2) % batches;
            const double ours = seconds_of(at, measured);
            const double theirs = seconds_of(other, bare);
            if (round < 0) continue;  // only warms up
            measured_s[at].push_back(ours);
            bare_s[other].push_back(theirs);
        }
    }
    double ours = 0.0;
    double theirs = 0.0;
    for (std::size_t at = 0; at < batches; ++at) {
        ours += quiet(measured_s[at]);
        theirs += quiet(bare_s[at]);
    }
    return {1e6 * ours / double(poses_in_all), ours / theirs};
}

void print_row(const tools::Resolution& resolution, Row& row, int rounds) {
    std::printf("%-8s", resolution.name().c_str());
    for (std::size_t k = 0; k < tools::method_count; ++k) {
        const auto method = static_cast<Method>(k);
        const Cell cell = compare(
            rounds, [&](std::size_t i) { row.scan(method, i); },
            [&](std::size_t i) { row.scan_bare(method, i); });
        std::printf("%10.2f %5.2f", cell.us, cell.ratio);
    }
    const Cell whole = compare(
        rounds, [&](std::size_t i) { row.scan(Method::depth_with_material, i); },
        [&](std::size_t i) { row.scan_whole(i); });
    std::printf("%8.2f\n", whole.ratio);
    std::fflush(stdout);
}

int measure(const std::string& file, int rounds) {
    const sim::SharedScene scene = sim::load_scene(file).scene;
    const auto rays = sim::make_backend("embree", scene);
    const auto depth = sim::make_backend("depth", scene);
    const sim::BareEmbree bare_rays(*scene, sim::BareEmbree::Movables::instances);
    const auto poses = tools::free_poses(*rays, poses_in_all, tools::robot_height_m);
    std::printf("us a scan, and how many times what a bare loop takes\n\n%-8s", "");
    for (const char* method : tools::method_names)
        std::printf("%10s %5s", method, "ratio");
    std::printf("%8s\n", "whole");
    for (const tools::Resolution& resolution : tools::paper_resolutions()) {
        Row row(scene, *rays, *depth, bare_rays, resolution, poses);
        if (!row.agree()) {
            std::fprintf(stderr, "%s: the bare loop measures something else\n",
                         resolution.name().c_str());
            return 1;
        }
        print_row(resolution, row, rounds);
    }
    return 0;
}

}  // namespace
}  // namespace scipd

int main(int argc, char** argv) {
    CLI::App program("Holds scipbench's table3 against bare loops.", "table3_bench");
    std::string scene = SCIPD_SCENES "/rescue_maze.sdf";
    int rounds = 20;
    program.add_option("--scene", scene, "world to measure in")->check(CLI::ExistingFile);
    program.add_option("--rounds", rounds, "how often each batch is measured")
        ->check(CLI::Range(1, 10'000));
    CLI11_PARSE(program, argc, argv);
    return scipd::measure(scene, rounds);
}
