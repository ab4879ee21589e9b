// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/staring.h"

#include <algorithm>
#include <limits>

namespace scipd::sim {
namespace {

constexpr float nothing = std::numeric_limits<float>::infinity();

SensorSpec in_steps(const StaringSpec& spec) {
    return {.steps_per_turn = spec.beams(),
            .first_step = 0,
            .last_step = spec.beams() - 1,
            .front_step = 0,
            .scan_period = spec.period,
            .max_range_m = spec.max_range_m,
            .noise = spec.noise};
}

}  // namespace

std::string_view StaringSpec::kind() const {
    return std::holds_alternative<PinholeGrid>(optics) ? "camera" : "ranger";
}

int StaringSpec::beams() const {
    const auto* const grid = std::get_if<PinholeGrid>(&optics);
    return grid != nullptr ? grid->columns * grid->rows : std::get<RangerOptics>(optics).cone.beams;
}

std::vector<glm::vec3> StaringSpec::directions() const {
    const auto* const grid = std::get_if<PinholeGrid>(&optics);
    return grid != nullptr ? grid->directions() : std::get<RangerOptics>(optics).cone.directions();
}

Staring::Staring(const StaringSpec& spec, const ErrorModel& errors)
    : spec_(spec), errors_(errors), steps_(in_steps(spec)) {
    if (const auto* const ranger = std::get_if<RangerOptics>(&spec_.optics))
        aggregation_.emplace(ranger->aggregate, spec_.directions());
}

Scanner Staring::make_scanner() const {
    return {steps_, BeamPattern(spec_.directions()), errors_};
}

float Staring::read_one(const Scan& scan) const {
    const auto speaker = aggregation_->choose(scan.hits);
    if (!speaker) return nothing;
    return errors_.read(steps_, Conditions{}.on_for, scan.revolution, scan.hits[*speaker]).range_m;
}

std::vector<float> Staring::read_all(const Scan& scan) {
    std::vector<float> range_m(scan.readings.size());
    std::ranges::transform(scan.readings, range_m.begin(), &Reading::range_m);
    return range_m;
}

std::vector<float> Staring::read(const Scan& scan) const {
    std::vector<float> range_m = aggregation_ ? std::vector{read_one(scan)} : read_all(scan);
    for (float& range : range_m) {
        const bool seen = range >= float(spec_.min_range_m) && range <= float(spec_.max_range_m);
        if (!seen) range = nothing;
    }
    return range_m;
}

}  // namespace scipd::sim
