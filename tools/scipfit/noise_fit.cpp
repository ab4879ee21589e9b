// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/noise_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace scipd::tools {
namespace {

constexpr std::size_t least_scans = 50;
constexpr std::size_t least_beams = 20;
constexpr std::size_t least_beams_of_step = 12;
constexpr double farthest_mm = 1e9;
constexpr std::array<double, 13> edges_mm{0,    500,  1000,  1500,  2000,  3000, 4000,
                                          6000, 8000, 12000, 16000, 24000, 32000};

/// Steps of range that have enough samples each. The first begins at 0.
std::vector<double> steps_for(const std::vector<LawSample>& samples) {
    std::vector<double> steps;
    std::size_t left = samples.size();
    for (const double edge : edges_mm) {
        const auto beyond = static_cast<std::size_t>(std::ranges::count_if(
            samples, [&](const LawSample& sample) { return sample.range_mm >= edge; }));
        const bool enough = left - beyond >= least_beams_of_step && beyond >= least_beams_of_step;
        if (!steps.empty() && !enough) continue;
        steps.push_back(edge);
        left = beyond;
    }
    return steps;
}

std::vector<LawSample> between(const std::vector<LawSample>& samples, double from_mm,
                               double to_mm) {
    std::vector<LawSample> within;
    std::ranges::copy_if(samples, std::back_inserter(within), [&](const LawSample& sample) {
        return sample.range_mm >= from_mm && sample.range_mm < to_mm;
    });
    return within;
}

void tell_extent(NoiseFit& fit) {
    const auto range = [](const LawSample& sample) { return sample.range_mm; };
    const auto light = [](const LawSample& sample) { return sample.intensity; };
    fit.nearest = *std::ranges::min_element(fit.samples, {}, range);
    fit.farthest = *std::ranges::max_element(fit.samples, {}, range);
    fit.dimmest = std::ranges::min_element(fit.samples, {}, light)->intensity;
    fit.brightest = std::ranges::max_element(fit.samples, {}, light)->intensity;
}

std::vector<LawSample> samples_in(const Standing& standing, const Weights& weights,
                                  bool by_intensity) {
    return samples_of(standing.stations, standing.sums, standing.readings->beam_rad(), weights,
                      by_intensity);
}

void find_intervals(const Standing& standing, NoiseFit& fit) {
    std::vector<double> s0;
    std::vector<double> i0;
    std::vector<std::vector<double>> steps(fit.model.steps.size());
    for (int i = 0; i < replicates; ++i) {
        const Weights weights = Weights::drawn(standing.sums, static_cast<unsigned>(i));
        const NoiseModel one =
            fit_model(samples_in(standing, weights, fit.model.by_intensity), fit.model);
        s0.push_back(one.s0_mm);
        i0.push_back(one.i0);
        for (std::size_t step = 0; step < steps.size(); ++step)
            steps[step].push_back(one.steps[step].sigma_mm);
    }
    fit.s0_mm = interval_of(fit.model.s0_mm, s0, true);
    if (fit.model.by_intensity) fit.i0 = interval_of(fit.model.i0, i0, true);
    for (std::size_t step = 0; step < steps.size(); ++step)
        fit.steps.push_back(interval_of(fit.model.steps[step].sigma_mm, steps[step], true));
}

std::string shown_number(double value) {
    return std::to_string(std::lround(value));
}

/// With the light of walls that are met head-on.
std::vector<LawSample> head_on(std::vector<LawSample> samples, double beam_rad) {
    for (LawSample& sample : samples)
        sample.intensity *= std::hypot(1.0, sample.slope_mm / (sample.range_mm * beam_rad));
    return samples;
}

/// Whether slanted walls are dimmer and yet not noisier: then noise goes by the range, as that of
/// scipd does at `accuracy: sensor`.
bool goes_by_range(const LawFit& law, const std::vector<LawSample>& samples,
                   const NoiseModel& start, double beam_rad) {
    constexpr double by_chance = 10.0;
    constexpr double share = 0.02;
    const LawFit other = fit_law(head_on(samples, beam_rad), start, true);
    return law.cost - other.cost > std::max(by_chance, share * law.cost);
}

/// Whether i0 is known to a quarter of it.
bool is_sure(const LawFit& law) {
    constexpr double too_large = 0.25;  // of its logarithm
    Jacobian jacobian = law.jacobian;
    for (std::size_t i = 1; i < jacobian.values.size(); i += jacobian.columns)
        jacobian.values[i] *= too_large;
    return known_parameters(jacobian)[1];
}

/// Whether the intensities tell i0; if not, why.
bool light_tells(const std::vector<LawSample>& samples, const NoiseModel& start, double beam_rad,
                 Unknowns& unknown) {
    if (samples.size() < least_beams) {
        unknown.push_back({"i0",
                           std::to_string(samples.size()) +
                               " beams before walls have an intensity, and " +
                               std::to_string(least_beams) + " are needed",
                           "scipcat record with --intensity"});
        return false;
    }
    const LawFit law = fit_law(samples, start, true);
    if (goes_by_range(law, samples, start, beam_rad)) {
        unknown.push_back({"i0", "the noise depends on the range, not on the intensity",
                           "a scanner whose noise depends on the received light"});
        return false;
    }
    if (is_sure(law)) return true;
    const auto light = [](const LawSample& sample) { return sample.intensity; };
    unknown.push_back({"i0",
                       "the noise does not depend on the intensity where that is " +
                           shown_number(std::ranges::min_element(samples, {}, light)->intensity) +
                           " to " +
                           shown_number(std::ranges::max_element(samples, {}, light)->intensity),
                       "dark or far faces beside bright ones"});
    return false;
}

std::optional<Unknown> why_no_noise(const Standing& standing, const std::vector<LawSample>& samples,
                                    double rounding_mm2) {
    if (standing.stations.empty())
        return Unknown{"sigma", "the scanner, or all that it sees, moves all the time",
                       "a recording of a standing scanner, 10 s or more"};
    if (standing.stations[0].scans() < least_scans)
        return Unknown{"sigma",
                       "the scanner is stationary for " +
                           std::to_string(standing.stations[0].scans()) +
                           " scans, and 50 are needed",
                       "a recording of a standing scanner, 50 scans or more"};
    if (samples.size() < least_beams)
        return Unknown{"sigma",
                       std::to_string(samples.size()) + " beams see a smooth face that stands " +
                           "still, and " + std::to_string(least_beams) + " are needed",
                       "visible walls, with nothing moving in front of them"};
    auto variances = samples;
    std::ranges::nth_element(variances, variances.begin() + variances.size() / 2, {},
                             &LawSample::variance_mm2);
    if (variances[variances.size() / 2].variance_mm2 < 2.0 * rounding_mm2)
        return Unknown{"sigma", "the noise is smaller than the quantization of the distances",
                       "a scanner with finer quantization"};
    return std::nullopt;
}

}  // namespace

NoiseModel fit_model(const std::vector<LawSample>& samples, NoiseModel kind) {
    const LawFit law = fit_law(samples, kind, kind.by_intensity);
    kind.s0_mm = law.s0_mm;
    kind.i0 = law.i0;
    NoiseModel one = kind;  // of which each step is fitted anew
    one.s0_mm = 0.0;
    for (std::size_t i = 0; i < kind.steps.size(); ++i) {
        const double to_mm = i + 1 < kind.steps.size() ? kind.steps[i + 1].from_mm : farthest_mm;
        const auto within = between(samples, kind.steps[i].from_mm, to_mm);
        kind.steps[i].sigma_mm = within.empty() ? law.s0_mm : fit_law(within, one, false).s0_mm;
    }
    return kind;
}

std::optional<NoiseFit> fit_noise(const Standing& standing, const NoiseModel& start,
                                  Unknowns& unknown) {
    NoiseFit fit;
    fit.samples = samples_in(standing, Weights(standing.sums), false);
    if (auto why = why_no_noise(standing, fit.samples, start.rounding_mm2)) {
        unknown.push_back(std::move(*why));
        return std::nullopt;
    }
    fit.model = start;
    auto lit = samples_in(standing, Weights(standing.sums), true);
    fit.model.by_intensity = standing.readings->has_intensities() &&
                             light_tells(lit, start, standing.readings->beam_rad(), unknown);
    if (fit.model.by_intensity) {
        fit.samples = std::move(lit);
    } else {
        for (const double from_mm : steps_for(fit.samples))
            fit.model.steps.push_back({from_mm, 0.0});
    }
    fit.model = fit_model(fit.samples, fit.model);
    fit.spread = fit_law(fit.samples, fit.model, fit.model.by_intensity).spread;
    tell_extent(fit);
    find_intervals(standing, fit);
    return fit;
}

}  // namespace scipd::tools
