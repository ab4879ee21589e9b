// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/staring_optics.h"

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>

#include "daemon/config/numbers.h"
#include "sim/text/likely_unit.h"
#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

using sim::quote;
using Keys = std::initializer_list<std::string_view>;

constexpr std::array<std::string_view, 6> camera_keys{"columns", "rows",    "fov_deg",
                                                      "rate_hz", "range_m", "noise"};
constexpr std::array<std::string_view, 6> ranger_keys{"cone_deg", "beams",   "aggregate",
                                                      "rate_hz",  "range_m", "noise"};
constexpr std::array<std::string_view, 2> noise_keys{"sigma_m", "share"};
constexpr std::array<std::string_view, 11> wire_keys{"tcp",          "pty",   "timing",  "power_up",
                                                     "clock",        "link",  "profile", "echo",
                                                     "interference", "noise", "bias"};
/// The thread that serves all sensors writes the numbers of a picture. So many take a tenth of a
/// second.
constexpr int most_pixels = 640 * 480;
constexpr int most_beams = 100'000;

sim::Expected<sim::Aggregate> parse_aggregate(std::string_view text) {
    if (text == "nearest") return sim::Aggregate::nearest;
    if (text == "weighted") return sim::Aggregate::weighted;
    return sim::refuse("must be nearest or weighted, not " + quote(text));
}

sim::Expected<int> parse_pixels(std::string_view text) {
    return parse_whole(text, 1, most_pixels);
}

sim::Expected<int> parse_beams(std::string_view text) {
    return parse_whole(text, 1, most_beams);
}

void require(const sim::YamlSection& section, const sim::YamlField& map, Keys keys,
             sim::YamlFaults& faults) {
    if (!map.value.IsMap()) return;
    for (const std::string_view key : keys) {
        if (!section.find(key)) faults.add(map, "needs " + std::string{key});
    }
}

void read_noise(const sim::YamlField& field, sim::StaringSpec& spec, sim::YamlFaults& faults) {
    const sim::YamlSection section{field, noise_keys, faults, "noise: {sigma_m: 0.01}"};
    sim::NoiseStep step{};
    section.read("sigma_m", step.sigma_m, parse_length);
    section.read("share", step.sigma_share, parse_share);
    const bool none = step.sigma_m == 0.0 && step.sigma_share == 0.0;
    if (!none) spec.noise = {step};
}

/// What both kinds have.
void read_rest(const sim::YamlSection& section, sim::StaringSpec& spec, sim::YamlFaults& faults) {
    section.read("rate_hz", spec.period, parse_rate);
    std::array<double, 2> range_m{0.0, 1.0};
    section.read_pair("range_m", range_m, parse_length);
    if (range_m[0] >= range_m[1]) {
        faults.add(*section.find("range_m"),
                   "must be [NEAREST, FARTHEST] in metres, such as [0.1, 7.5]");
    }
    constexpr double nearest_of_any_m = 10.0;
    if (range_m[0] >= nearest_of_any_m && sim::could_be_millimetres(range_m))
        faults.warn(*section.find("range_m"), sim::millimetres_for_metres(range_m));
    spec.min_range_m = range_m[0];
    spec.max_range_m = range_m[1];
    if (const sim::YamlField* noise = section.find("noise")) read_noise(*noise, spec, faults);
}

}  // namespace

sim::StaringSpec read_camera(const sim::YamlField& field, sim::YamlFaults& faults) {
    const sim::YamlSection section{field, camera_keys, faults};
    require(section, field, {"columns", "rows", "fov_deg", "rate_hz", "range_m"}, faults);
    sim::PinholeGrid grid{1, 1, 1.0, 1.0};
    section.read("columns", grid.columns, parse_pixels);
    section.read("rows", grid.rows, parse_pixels);
    if (std::int64_t{grid.columns} * grid.rows > most_pixels) {
        faults.add(field, "columns times rows must not exceed 307200");
    }
    std::array<double, 2> fov_rad{1.0, 1.0};
    section.read_pair("fov_deg", fov_rad, parse_view);
    grid.width_rad = fov_rad[0];
    grid.height_rad = fov_rad[1];
    sim::StaringSpec spec{.optics = grid};
    read_rest(section, spec, faults);
    return spec;
}

sim::StaringSpec read_ranger(const sim::YamlField& field, sim::YamlFaults& faults) {
    const sim::YamlSection section{field, ranger_keys, faults};
    require(section, field, {"cone_deg", "beams", "rate_hz", "range_m"}, faults);
    sim::RangerOptics optics{.cone = {1.0, 1}};
    section.read("cone_deg", optics.cone.opening_rad, parse_cone);
    section.read("beams", optics.cone.beams, parse_beams);
    section.read("aggregate", optics.aggregate, parse_aggregate);
    sim::StaringSpec spec{.optics = optics};
    read_rest(section, spec, faults);
    return spec;
}

void refuse_wire(const sim::YamlSection& sensor, sim::YamlFaults& faults) {
    for (const std::string_view key : wire_keys) {
        if (const sim::YamlField* field = sensor.find(key)) {
            faults.add(*field,
                       "is of scanners, which speak SCIP; a camera or ranger is read through the "
                       "control API: leave it out");
        }
    }
}

}  // namespace scipd::daemon
