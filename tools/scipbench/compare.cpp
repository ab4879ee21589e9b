// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/compare.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#include "sim/backends/registry.h"
#include "tools/scipbench/free_poses.h"

namespace scipd::tools {
namespace {

using Scans = std::vector<std::vector<sim::Hit>>;

constexpr double half_pixel_rad = 0.75e-3;
constexpr double other_surface_m = 0.01;

Scans cast_all(sim::RangeBackend& backend, const std::vector<glm::vec3>& directions,
               const std::vector<sim::Pose>& poses, float max_range_m, std::vector<double>& ms) {
    Scans scans;
    for (const sim::Pose& pose : poses) {
        std::vector<sim::Hit>& hits = scans.emplace_back(directions.size());
        const sim::Fan fan{directions, {&pose, 1}, max_range_m};
        ms.push_back(milliseconds_for([&] { backend.cast(fan, hits); }));
    }
    ms.erase(ms.begin());  // the first scan only warms up
    return scans;
}

std::vector<sim::Pose> turned(std::vector<sim::Pose> poses, double yaw_rad) {
    for (sim::Pose& pose : poses)
        pose = pose * sim::pose_from_rpy({0, 0, 0}, {0, 0, yaw_rad});
    return poses;
}

/// Whether a ray beside another one hits something else: another object, or a surface in front of
/// or behind the first. It allows for how much the range changes along a slanted surface between
/// the two rays.
bool is_edge(const sim::Hit& hit, const sim::Hit& beside) {
    if (hit.object != beside.object) return true;
    if (!hit.met()) return false;
    const double cosine = std::max({double{hit.cos_incidence}, double{beside.cos_incidence}, 1e-3});
    const double slope = std::sqrt(std::max(0.0, 1.0 - cosine * cosine)) / cosine;
    const double along_m =
        2.0 * half_pixel_rad * slope * double{std::min(hit.range_m, beside.range_m)};
    return std::abs(double{hit.range_m} - double{beside.range_m}) > other_surface_m + along_m;
}

/// For each beam of each scan, whether it has an edge within half a pixel.
std::vector<std::vector<bool>> find_edges(sim::RangeBackend& rays, const Scans& truth,
                                          const std::vector<glm::vec3>& directions,
                                          const std::vector<sim::Pose>& poses, float max_range_m) {
    std::vector<std::vector<bool>> edges(poses.size(), std::vector<bool>(directions.size()));
    for (const double side_rad : {-half_pixel_rad, half_pixel_rad}) {
        std::vector<double> unused;
        const Scans beside =
            cast_all(rays, directions, turned(poses, side_rad), max_range_m, unused);
        for (std::size_t scan = 0; scan < truth.size(); ++scan) {
            for (std::size_t i = 0; i < directions.size(); ++i) {
                if (is_edge(truth[scan][i], beside[scan][i])) edges[scan][i] = true;
            }
        }
    }
    return edges;
}

double off_m(const sim::Hit& hit, const sim::Hit& truth) {
    if (hit.met() != truth.met()) return std::numeric_limits<double>::infinity();
    return truth.met() ? std::abs(double{hit.range_m} - double{truth.range_m}) : 0.0;
}

Comparison compare(std::string backend, const Scans& scans, const Scans& truth,
                   const std::vector<std::vector<bool>>& edges) {
    Comparison it{.backend = std::move(backend)};
    std::vector<double> away_m;
    for (std::size_t scan = 0; scan < truth.size(); ++scan) {
        for (std::size_t i = 0; i < truth[scan].size(); ++i) {
            const double off = off_m(scans[scan][i], truth[scan][i]);
            const bool edge = edges[scan][i];
            ++it.beams;
            if (edge) ++it.edges;
            if (off > other_surface_m) ++it.other_surface;
            if (edge) continue;
            away_m.push_back(off);
            if (off <= other_surface_m && scans[scan][i].object != truth[scan][i].object)
                ++it.other_object;
        }
    }
    std::ranges::sort(away_m);
    it.off_m = {at_share(away_m, 0.5), at_share(away_m, 0.99), at_share(away_m, 0.999),
                at_share(away_m, 1.0)};
    return it;
}

/// For the picture: notes what was hit, and where `scans` differ from it. `scans` may be empty.
void note_places(ComparedScans& compared, const Scans& scans, const Scans& truth,
                 const std::vector<glm::vec3>& directions, const std::vector<sim::Pose>& poses) {
    constexpr double worth_showing_m = 1e-3;
    for (std::size_t scan = 0; scan < poses.size(); ++scan) {
        for (std::size_t i = 0; i < directions.size(); ++i) {
            const sim::Hit& hit = truth[scan][i];
            if (!hit.met()) continue;
            const glm::dvec3 place_m =
                poses[scan] * (double{hit.range_m} * glm::dvec3{directions[i]});
            compared.hits_m.push_back(place_m);
            const double off = scans.empty() ? 0.0 : off_m(scans[scan][i], hit);
            if (off > worth_showing_m) compared.differences.push_back({place_m, off});
        }
    }
}

}  // namespace

ComparedScans compare_backends(const sim::SharedScene& scene,
                               const std::vector<glm::vec3>& directions, double max_range_m,
                               std::size_t count, double height_m) {
    const auto range_m = static_cast<float>(max_range_m);
    const auto rays = sim::preferred_backend().make(scene, {});
    const auto poses = free_poses(*rays, count, height_m);
    std::vector<double> ms;
    const Scans truth = cast_all(*rays, directions, poses, range_m, ms);
    const auto edges = find_edges(*rays, truth, directions, poses, range_m);
    ComparedScans compared;
    Scans drawn;
    for (const sim::BackendRow& row : sim::backends()) {
        try {
            const auto backend = row.make(scene, {});
            ms.clear();
            Scans scans = cast_all(*backend, directions, poses, range_m, ms);
            compared.backends.push_back(compare(std::string(row.name), scans, truth, edges));
            compared.backends.back().cost_ms = spread_of(ms);
            if (row.draws) drawn = std::move(scans);
        } catch (const std::runtime_error& error) {
            compared.backends.push_back(
                {.backend = std::string(row.name), .missing = error.what()});
        }
    }
    note_places(compared, drawn, truth, directions, poses);
    return compared;
}

void print_comparison(const ComparedScans& scans, std::ostream& out) {
    out << "against " << sim::preferred_backend().name
        << ", away from edges, in mm                                beams in %\n"
        << "backend      ms/scan      p50      p99    p99.9        max     at edges   off > 1 cm"
           "   other object\n"
        << std::fixed;
    for (const Comparison& it : scans.backends) {
        out << std::left << std::setw(10) << it.backend << std::right;
        if (!it.missing.empty()) {
            out << "  " << it.missing << "\n";
            continue;
        }
        out << std::setprecision(3) << std::setw(10) << it.cost_ms.median << std::setprecision(4);
        for (std::size_t i = 0; i < it.off_m.size(); ++i)
            out << std::setw(i + 1 < it.off_m.size() ? 9 : 11) << 1e3 * it.off_m[i];
        for (const std::size_t share : {it.edges, it.other_surface, it.other_object})
            out << std::setw(13) << 100.0 * double(share) / double(it.beams);
        out << "\n";
    }
}

void write_comparison_json(const ComparedScans& scans, std::ostream& out) {
    nlohmann::json all = nlohmann::json::array();
    for (const Comparison& it : scans.backends) {
        nlohmann::json one{{"backend", it.backend}};
        if (!it.missing.empty()) {
            one["missing"] = it.missing;
        } else {
            const auto share = [&](std::size_t beams) { return double(beams) / double(it.beams); };
            one["ms_per_scan"] = it.cost_ms.median;
            one["off_m"] = {{"p50", it.off_m[0]},
                            {"p99", it.off_m[1]},
                            {"p99.9", it.off_m[2]},
                            {"max", it.off_m[3]}};
            one["beams"] = it.beams;
            one["edge_share"] = share(it.edges);
            one["other_surface_share"] = share(it.other_surface);
            one["other_object_share"] = share(it.other_object);
        }
        all.push_back(std::move(one));
    }
    out << all.dump(2) << "\n";
}

}  // namespace scipd::tools
