// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Point to line (Y. Chen, G. Medioni, "Object modelling by registration of multiple range images",
// 1992) with the weights of Tukey, whose reach shrinks from step to step. Beside the motion it has
// the error of B's ranges against A's as a function of the range: two units of one model differ by
// some 10 mm. A place may not tell the two apart, as a single wall ahead does not. Then the motion
// is uncertain, and if it need not be one, it is taken for none.
#include "tools/scipcat/compare/planar_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include "tools/scipcat/compare/normal_equations.h"

namespace scipd::tools::comparing {
namespace {

// What is to be expected.
constexpr double motion_mm = 300;
constexpr double turn_rad = 0.1;
constexpr double range_error_mm = 15;

/// The range error is known at these, and even between them by the logarithm of the range.
constexpr double first_knot_mm = 250;
constexpr std::size_t knots = 8;

/// Forward, left and turn, then the range error at each knot.
using Equations = NormalEquations<3 + knots>;
using Unknowns = Equations::Vector;

/// How much each knot counts at a range.
std::array<double, knots> knots_at(double range_mm) {
    std::array<double, knots> counts{};
    const double place = std::clamp(std::log2(range_mm / first_knot_mm), 0.0, knots - 1.001);
    const auto below = static_cast<std::size_t>(place);
    counts[below + 1] = place - static_cast<double>(below);
    counts[below] = 1 - counts[below + 1];
    return counts;
}

struct Residuals {
    Equations equations;
    std::vector<double> sizes_mm;
};

/// The line of A that this point of B belongs to.
const WallLine* line_near(const Outline& a, glm::dvec2 point) {
    const auto beam = a.beam_at(bearing_of(point));
    return beam && a.lines[*beam] ? &*a.lines[*beam] : nullptr;
}

Residuals residuals_at(const Outline& a, const Outline& b, const Unknowns& state, double reach_mm) {
    Residuals residuals;
    const PlanarMotion motion{{state[0], state[1]}, state[2]};
    for (std::size_t beam = 0; beam < b.ranges_mm.size(); ++beam) {
        const double range_mm = b.ranges_mm[beam];
        if (std::isnan(range_mm)) continue;
        const auto counts = knots_at(range_mm);
        double error_mm = 0;
        for (std::size_t i = 0; i < knots; ++i)
            error_mm += counts[i] * state[3 + i];
        const glm::dvec2 out = direction_at(b.angle_rad(beam) + motion.turn_rad);
        const glm::dvec2 arm = (range_mm - error_mm) * out;
        const WallLine* const line = line_near(a, arm + motion.shift_mm);
        if (line == nullptr) continue;
        Unknowns gradient{line->normal.x, line->normal.y,
                          glm::dot(line->normal, glm::dvec2(-arm.y, arm.x))};
        for (std::size_t i = 0; i < knots; ++i)
            gradient[3 + i] = -counts[i] * glm::dot(line->normal, out);
        const double residual_mm =
            glm::dot(line->normal, arm + motion.shift_mm) - line->distance_mm;
        residuals.sizes_mm.push_back(std::abs(residual_mm));
        const double share = std::min(1.0, std::abs(residual_mm) / reach_mm);
        residuals.equations.add(gradient, residual_mm, std::pow(1 - share * share, 2));
    }
    return residuals;
}

void expect_little(Equations& equations, const Unknowns& state, double deviation_mm) {
    for (std::size_t i = 0; i < state.size(); ++i) {
        const double expected = i < 2 ? motion_mm : i == 2 ? turn_rad : range_error_mm;
        Unknowns gradient{};
        gradient[i] = deviation_mm / expected;
        equations.add(gradient, gradient[i] * state[i], 1);
    }
}

/// The motion, or none if it may be chance.
FittedMotion judged(const Unknowns& state, const Equations& equations, double deviation_mm) {
    constexpr double surely = 20;      // of chi-squared with three degrees of freedom: 0.0002
    constexpr double alike_beams = 9;  // a line is of so many, which therefore err together
    const auto covariance = equations.covariance();
    FittedMotion fitted{{{state[0], state[1]}, state[2]}};
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row)
            fitted.covariance[column][row] =
                alike_beams * deviation_mm * deviation_mm * covariance[column][row];
    }
    const glm::dvec3 motion{state[0], state[1], state[2]};
    const double chi_squared = glm::dot(motion, glm::inverse(fitted.covariance) * motion);
    return chi_squared > surely ? fitted : FittedMotion{};
}

}  // namespace

glm::dvec2 PlanarMotion::operator()(glm::dvec2 point_mm) const {
    const glm::dvec2 x = direction_at(turn_rad);
    return point_mm.x * x + point_mm.y * glm::dvec2(-x.y, x.x) + shift_mm;
}

glm::dvec2 PlanarMotion::back(glm::dvec2 point_mm) const {
    return PlanarMotion{{}, -turn_rad}(point_mm - shift_mm);
}

WallLine PlanarMotion::operator()(const WallLine& line) const {
    const glm::dvec2 normal = PlanarMotion{{}, turn_rad}(line.normal);
    return {normal, line.distance_mm + glm::dot(normal, shift_mm)};
}

std::optional<FittedMotion> fit_motion(const Outline& a, const Outline& b) {
    constexpr int steps = 30;
    constexpr std::size_t fewest = 30;
    constexpr double widest_mm = 300;
    constexpr double narrowest_mm = 8;
    constexpr double tukey = 4.685;  // his reach, in standard deviations
    Unknowns state{};
    double reach_mm = widest_mm;
    for (int step = 0;; ++step) {
        Residuals residuals = residuals_at(a, b, state, reach_mm);
        if (residuals.sizes_mm.size() < fewest) return std::nullopt;
        const double deviation_mm = std::max(1.0, 1.483 * median_of(residuals.sizes_mm));
        expect_little(residuals.equations, state, deviation_mm);
        if (step == steps) return judged(state, residuals.equations, deviation_mm);
        const Unknowns by = residuals.equations.solve();
        for (std::size_t i = 0; i < state.size(); ++i)
            state[i] += by[i];
        reach_mm =
            std::clamp(std::max(0.8 * reach_mm, tukey * deviation_mm), narrowest_mm, widest_mm);
    }
}

}  // namespace scipd::tools::comparing
