// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/compare/outline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

namespace scipd::tools::comparing {
namespace {

constexpr std::size_t line_reach = 4;  ///< beams to either side
constexpr double roughest_mm = 25;

bool joins(const Outline& outline, std::size_t beam, std::size_t next) {
    const double range_mm = outline.ranges_mm[beam];
    const double next_mm = outline.ranges_mm[next];
    return !std::isnan(range_mm) && !std::isnan(next_mm) &&
           on_one_surface(range_mm, next_mm, std::abs(outline.increment_rad));
}

/// Least squares of the distances from the line; what they are at the root of their mean square.
double fit_line(std::span<const glm::dvec2> points, WallLine& line) {
    const auto count = static_cast<double>(points.size());
    glm::dvec2 middle{};
    for (const glm::dvec2& point : points)
        middle += point / count;
    double xx = 0;
    double xy = 0;
    double yy = 0;
    for (const glm::dvec2& point : points) {
        const glm::dvec2 from_middle = point - middle;
        xx += from_middle.x * from_middle.x;
        xy += from_middle.x * from_middle.y;
        yy += from_middle.y * from_middle.y;
    }
    const double along_rad = std::atan2(2 * xy, xx - yy) / 2;
    line.normal = {-std::sin(along_rad), std::cos(along_rad)};
    line.distance_mm = glm::dot(line.normal, middle);
    double squares = 0;
    for (const glm::dvec2& point : points)
        squares += std::pow(glm::dot(line.normal, point) - line.distance_mm, 2);
    return std::sqrt(squares / count);
}

struct FittedLine {
    WallLine line;
    double rough_mm = roughest_mm;
};

/// Through the points of these beams, if they are on one surface.
FittedLine line_through_beams(const Outline& outline, std::size_t first, std::size_t last) {
    std::vector<glm::dvec2> points;
    for (std::size_t i = first; i <= last; ++i) {
        if (i > first && !joins(outline, i - 1, i)) return {};
        points.push_back(outline.point_mm(i));
    }
    FittedLine fitted;
    fitted.rough_mm = fit_line(points, fitted.line);
    return fitted;
}

/// Through the beams to both sides; where that is rough, as in a corner, to one side.
std::optional<WallLine> line_at(const Outline& outline, std::size_t beam) {
    constexpr double smooth_mm = 3;
    constexpr double most_grazing = 0.12;  // cosine of the incidence
    const std::size_t first = beam - std::min(beam, line_reach);
    const std::size_t last = std::min(beam + line_reach, outline.ranges_mm.size() - 1);
    if (last - first < line_reach) return std::nullopt;
    FittedLine best = line_through_beams(outline, first, last);
    if (best.rough_mm > smooth_mm) {
        for (const auto& [from, to] : {std::pair(first, beam), std::pair(beam, last)}) {
            if (to - from < line_reach) continue;
            const FittedLine side = line_through_beams(outline, from, to);
            if (side.rough_mm < best.rough_mm) best = side;
        }
    }
    if (!(best.rough_mm < roughest_mm)) return std::nullopt;
    const double incidence = glm::dot(best.line.normal, direction_at(outline.angle_rad(beam)));
    if (std::abs(incidence) < most_grazing) return std::nullopt;
    return best.line;
}

}  // namespace

glm::dvec2 Outline::point_mm(std::size_t beam) const {
    return ranges_mm[beam] * direction_at(angle_rad(beam));
}

std::optional<std::size_t> Outline::beam_at(double angle_rad) const {
    const double from_first = std::remainder(
        angle_rad - first_rad - increment_rad * static_cast<double>(ranges_mm.size() - 1) / 2,
        2 * std::numbers::pi);
    const double beam =
        std::round(from_first / increment_rad + static_cast<double>(ranges_mm.size() - 1) / 2);
    if (beam < 0 || beam >= static_cast<double>(ranges_mm.size())) return std::nullopt;
    return static_cast<std::size_t>(beam);
}

glm::dvec2 direction_at(double angle_rad) {
    return {std::cos(angle_rad), std::sin(angle_rad)};
}

double bearing_of(glm::dvec2 point) {
    return std::atan2(point.y, point.x);
}

double range_to(const WallLine& line, double angle_rad) {
    return line.distance_mm / glm::dot(line.normal, direction_at(angle_rad));
}

std::optional<Outline> outline_of(const sim::Directions& directions,
                                  std::span<const BeamStatistics> beams) {
    if (!directions.first_rad || !directions.increment_rad || *directions.increment_rad == 0)
        return std::nullopt;
    // A cluster looks where the middle of its steps does.
    const double step_rad = *directions.increment_rad / directions.cluster;
    Outline outline{.first_rad = *directions.first_rad + (directions.cluster - 1) / 2.0 * step_rad,
                    .increment_rad = *directions.increment_rad};
    for (const BeamStatistics& beam : beams)
        outline.ranges_mm.push_back(beam.share >= 0.5 ? beam.median_mm
                                                      : std::numeric_limits<double>::quiet_NaN());
    for (std::size_t beam = 0; beam < beams.size(); ++beam)
        outline.lines.push_back(line_at(outline, beam));
    return outline;
}

}  // namespace scipd::tools::comparing
