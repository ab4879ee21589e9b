// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/compare/beam_pairs.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace scipd::tools::comparing {
namespace {

/// How many beams an edge may have moved by, since B stands elsewhere: things before it and behind
/// it move by other angles.
std::size_t edge_moved_by(const Outline& a, const PlanarMotion& motion, double nearest_mm) {
    constexpr double not_at_all = 0.05;
    const double increment_rad = std::abs(a.increment_rad);
    const double turned = motion.turn_rad / increment_rad;
    const double beams = glm::length(motion.shift_mm) / (nearest_mm * increment_rad) +
                         std::abs(turned - std::round(turned));
    if (!(beams > not_at_all)) return 0;
    return static_cast<std::size_t>(std::min(std::ceil(beams), 1e4));
}

/// The nearer of what a beam and its neighbours see.
double nearest_around(const Outline& a, std::size_t beam) {
    double nearest_mm = 1e9;
    for (std::size_t i = beam == 0 ? 0 : beam - 1; i < a.ranges_mm.size() && i <= beam + 1; ++i)
        nearest_mm = std::fmin(nearest_mm, a.ranges_mm[i]);
    return nearest_mm;
}

void leave_out_moved_edges(std::vector<BeamPair>& pairs, const Outline& a,
                           const PlanarMotion& motion) {
    std::vector<bool> left_out(pairs.size(), false);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (!pairs[i].at_edge) continue;
        const std::size_t beams = edge_moved_by(a, motion, nearest_around(a, pairs[i].a));
        if (beams == 0) continue;
        const std::size_t end = std::min(pairs.size(), i + beams);
        for (std::size_t k = i + 1 - std::min(i + 1, beams); k < end; ++k)
            left_out[k] = true;
    }
    for (std::size_t i = 0; i < pairs.size(); ++i)
        pairs[i].comparable = !left_out[i];
}

/// Where A's beam meets what it sees, as B has it; where it sees nothing, far away.
double bearing_for_b(const Outline& a, std::size_t beam, const PlanarMotion& a_from_b) {
    constexpr double far_mm = 1e7;
    const bool sees = !std::isnan(a.ranges_mm[beam]);
    return bearing_of(
        a_from_b.back(sees ? a.point_mm(beam) : far_mm * direction_at(a.angle_rad(beam))));
}

/// How much nearer the line that B's beam meets is to B than to A. If A's beam meets the line of
/// another beam instead, that counts.
double nearer_for_b(const Outline& a, const Outline& b, const PlanarMotion& a_from_b,
                    const BeamPair& pair, std::size_t line_of) {
    if (b.lines[pair.b] && b.lines[line_of]) {
        const double for_a_mm = range_to(a_from_b(*b.lines[line_of]), a.angle_rad(pair.a));
        return for_a_mm - range_to(*b.lines[pair.b], b.angle_rad(pair.b));
    }
    if (std::isnan(b.ranges_mm[pair.b])) return 0;
    return glm::length(a_from_b(b.point_mm(pair.b))) - b.ranges_mm[pair.b];
}

/// How well that is known, as the motion is. 0 where there is no line to tell by.
double uncertainty_mm(const Outline& a, const Outline& b, const FittedMotion& fitted,
                      const BeamPair& pair) {
    if (!b.lines[pair.b]) return 0;
    const WallLine line = fitted.motion(*b.lines[pair.b]);
    const glm::dvec2 out = direction_at(a.angle_rad(pair.a));
    const glm::dvec2 arm = range_to(line, a.angle_rad(pair.a)) * out - fitted.motion.shift_mm;
    const glm::dvec3 gradient =
        glm::dvec3(line.normal, glm::dot(line.normal, glm::dvec2(-arm.y, arm.x))) /
        glm::dot(line.normal, out);
    return std::sqrt(glm::dot(gradient, fitted.covariance * gradient));
}

/// In a corner A's beam may meet the one wall and B's the other.
bool in_corner(const Outline& a, const Outline& b, const PlanarMotion& a_from_b,
               const BeamPair& pair) {
    constexpr std::size_t beams = 2;
    constexpr double most_mm = 2;
    for (const std::size_t other :
         {pair.b - std::min(pair.b, beams), std::min(pair.b + beams, b.ranges_mm.size() - 1)}) {
        const double nearer_mm = nearer_for_b(a, b, a_from_b, pair, other);
        if (std::abs(nearer_mm - pair.nearer_mm) > most_mm) return true;
    }
    return false;
}

}  // namespace

std::vector<BeamPair> pairs_by_angle(const Outline& a, const Outline& b, const FittedMotion& fitted,
                                     const std::vector<bool>& edges_a,
                                     const std::vector<bool>& edges_b) {
    const PlanarMotion& a_from_b = fitted.motion;
    std::vector<BeamPair> pairs;
    for (std::size_t beam = 0; beam < a.ranges_mm.size(); ++beam) {
        const auto of_b = b.beam_at(bearing_for_b(a, beam, a_from_b));
        if (!of_b) continue;
        BeamPair pair{.a = beam, .b = *of_b, .at_edge = edges_a[beam] || edges_b[*of_b]};
        pair.nearer_mm = nearer_for_b(a, b, a_from_b, pair, pair.b);
        pair.uncertain_mm = uncertainty_mm(a, b, fitted, pair);
        pair.at_edge = pair.at_edge || in_corner(a, b, a_from_b, pair);
        pairs.push_back(pair);
    }
    leave_out_moved_edges(pairs, a, a_from_b);
    return pairs;
}

sim::Expected<std::vector<BeamPair>> pairs_by_number(const ScanTable& a, const ScanTable& b,
                                                     const std::vector<bool>& edges_a,
                                                     const std::vector<bool>& edges_b) {
    if (a.directions.cluster != b.directions.cluster)
        return sim::refuse("A and B join other numbers of steps, and do not say where these look");
    const auto first_a = a.directions.first_step;
    const auto first_b = b.directions.first_step;
    if ((!first_a || !first_b) && a.beams != b.beams)
        return sim::refuse("A has " + std::to_string(a.beams) + " steps and B has " +
                           std::to_string(b.beams) + ", and not both say where these look");
    const int ahead = first_a && first_b ? (*first_a - *first_b) / a.directions.cluster : 0;
    std::vector<BeamPair> pairs;
    for (std::size_t beam = 0; beam < a.beams; ++beam) {
        const auto of_b = static_cast<std::ptrdiff_t>(beam) + ahead;
        if (of_b < 0 || of_b >= static_cast<std::ptrdiff_t>(b.beams)) continue;
        const auto at = static_cast<std::size_t>(of_b);
        pairs.push_back({.a = beam, .b = at, .at_edge = edges_a[beam] || edges_b[at]});
    }
    return pairs;
}

}  // namespace scipd::tools::comparing
