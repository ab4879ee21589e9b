// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/light_fit.h"

#include <algorithm>
#include <cmath>

namespace scipd::tools {
namespace {

constexpr std::size_t least_lit_beams = 12;

/// One beam's light over the time of a station.
struct BeamLight {
    double range_mm, intensity, head_on, share;
};

/// Around the mean of the scans before and behind: light that drifts is no noise.
BeamLight light_of(const Standing& standing, const Station& station, std::size_t step) {
    const ScanTable& readings = *standing.readings;
    const Beam& beam = station.beams[step];
    double squares = 0.0;
    double count = 0.0;
    for (std::size_t scan = station.first + 1; scan < station.end; ++scan) {
        const double difference =
            readings.intensity(scan, step) - readings.intensity(scan - 1, step);
        if (std::isnan(difference)) continue;
        squares += difference * difference;
        count += 1.0;
    }
    const double rounding = 1.0 / 12.0;  // intensities are whole numbers
    const double variance = count > 0.0 ? std::max(0.0, 0.5 * squares / count - rounding) : 0.0;
    const double tangent = beam.slope_mm / (beam.mean_mm * readings.beam_rad());
    return {beam.mean_mm, beam.intensity, beam.intensity * std::sqrt(1.0 + tangent * tangent),
            std::sqrt(variance) / std::max(1.0, beam.intensity)};
}

/// The middle, and how well it is known.
Interval middle_of(std::vector<double> values) {
    std::ranges::sort(values);
    const double n = static_cast<double>(values.size());
    const auto at = [&](double place) {
        const double inside = std::clamp(place, 0.0, n - 1.0);
        return values[static_cast<std::size_t>(inside)];
    };
    // Neighbouring beams see the same wall: as if there were a fifth as many.
    const double half = 0.98 * std::sqrt(5.0 * n);
    return {at(0.5 * n), at(0.5 * n - half), at(0.5 * n + half)};
}

/// Cuts what is sorted into groups of the size that is left over, and hands out each.
template <class Value, class Take>
void in_groups(const std::vector<Value>& sorted, std::size_t groups, const Take& take) {
    groups = std::min(groups, sorted.size() / least_lit_beams);
    for (std::size_t i = 0; i < groups; ++i) {
        const auto at = [&](std::size_t group) {
            return sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * group / groups);
        };
        take(std::vector<Value>(at(i), at(i + 1)));
    }
}

template <class Member>
std::vector<double> each(const std::vector<BeamLight>& lights, Member member) {
    std::vector<double> values;
    for (const BeamLight& light : lights)
        values.push_back(light.*member);
    return values;
}

}  // namespace

LightFit fit_light(const Standing& standing) {
    constexpr std::size_t most_groups = 6;
    LightFit fit;
    if (!standing.readings->has_intensities()) return fit;
    std::vector<BeamLight> lights;
    for (const Station& station : standing.stations) {
        for (std::size_t step = 0; step < station.beams.size(); ++step) {
            const Beam& beam = station.beams[step];
            if (beam.inside && beam.intensity > 0.0)
                lights.push_back(light_of(standing, station, step));
        }
    }
    std::ranges::sort(lights, {}, &BeamLight::intensity);
    in_groups(lights, most_groups, [&](const std::vector<BeamLight>& group) {
        fit.noise.push_back({middle_of(each(group, &BeamLight::intensity)).value,
                             middle_of(each(group, &BeamLight::share)), group.size()});
    });
    std::ranges::sort(lights, {}, &BeamLight::range_mm);
    in_groups(lights, most_groups, [&](const std::vector<BeamLight>& group) {
        fit.by_range.push_back({middle_of(each(group, &BeamLight::range_mm)).value,
                                middle_of(each(group, &BeamLight::head_on)).value, group.size()});
    });
    return fit;
}

}  // namespace scipd::tools
