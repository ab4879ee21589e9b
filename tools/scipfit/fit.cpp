// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/fit.h"

#include <cmath>

#include "sim/text/quote.h"

namespace scipd::tools {
namespace {

constexpr std::size_t least_scans_for_pairs = 50;
constexpr std::size_t least_pairs = 20;
constexpr std::size_t least_scans_for_after = 80;

/// What neighbours share tells of the smoothing only where enough of them stand still long enough.
std::optional<SmoothingFit> smoothing_of(const Standing& standing, const Lattice& lattice,
                                         bool whole_mm, Unknowns& unknown) {
    const std::size_t scans = standing.stations.empty() ? 0 : standing.stations[0].scans();
    const auto leave = [&](const std::string& why) {
        unknown.push_back({"neighbours", why, "50 scans or more that stand still before walls"});
        return std::nullopt;
    };
    if (scans < least_scans_for_pairs)
        return leave("the scanner stands for " + std::to_string(scans) + " scans");
    const double place_mm = std::max(lattice.spacing_mm, whole_mm ? 1.0 : 0.0);
    SmoothingFit fit =
        fit_smoothing(standing.stations, standing.sums, lattice.rounding_mm2(whole_mm), place_mm);
    if (fit.pairs < least_pairs)
        return leave(std::to_string(fit.pairs) + " pairs of beams see one face that stands still");
    if (scans < least_scans_for_after)
        unknown.push_back({"scans", "what scans share with the next one takes 80 scans to be seen",
                           "a longer recording that stands still"});
    return fit;
}

void tell_what_one_place_cannot(const Fit& fit, Unknowns& unknown) {
    if (fit.bias.empty())
        unknown.push_back({"offset",
                           "where a wall is, and what the scanner reads too far, look the same",
                           "a length that was measured: --length STEP:STEP=METRES"});
    unknown.push_back(
        {"scale", "a larger room looks the same", "lengths that were measured at several ranges"});
    unknown.push_back({"angle_offset", "a room that is turned looks the same",
                       "a world and a pose that are known, with two walls that are not parallel"});
    if (!fit.light.by_range.empty())
        unknown.push_back({"reflectance", "only its product with the gain of the receiver shows",
                           "a target whose reflectance is known"});
    unknown.push_back({"warm_up", "how long the scanner was on before is not known",
                       "a recording from the cold start on, before a target that does not move"});
}

void tell_what_is_missing(const Readings& readings, Fit& fit) {
    Unknowns& unknown = fit.unknown;
    if (!fit.kind.known)
        unknown.push_back({"model", fit.kind.from, "--model, or a recording by scipcat record"});
    if (!readings.has_intensities)
        unknown.push_back(
            {"i0", "the recording has no intensities", "scipcat record with --intensity"});
    if (!readings.has_codes)
        unknown.push_back(
            {"codes", "the recording is in metres, without the scanner's codes", "scipcat record"});
    if (fit.lattice.cells == 0 && fit.lattice.spacing_mm == 0.0)
        unknown.push_back(
            {"lattice", "too few distances lie close together", "more scans that stand still"});
    if (!fit.mixed)
        unknown.push_back({"mixed_beams", "fewer than eight edges are 0.15 to 1 m deep",
                           "boxes that stand before walls"});
    if (!fit.drift) unknown.push_back({"drift", "too few beams stand still", "a longer recording"});
    tell_what_one_place_cannot(fit, unknown);
}

}  // namespace

Standing look_at(const Readings& readings) {
    Standing standing{&readings, stations_of(readings), {}};
    for (const Station& station : standing.stations)
        standing.sums.push_back(sums_of(readings, station));
    return standing;
}

Fit fit_scanner(const Standing& standing, const Kind& kind, const std::vector<Length>& lengths) {
    const Readings& readings = *standing.readings;
    Fit fit{.kind = kind, .files = readings.files, .all_scans = readings.scans()};
    for (const Station& station : standing.stations)
        fit.scans += station.scans();
    fit.beams = beams_inside(standing.stations);
    fit.stations = standing.stations.size();
    fit.doubles = readings.doubles;
    fit.lattice = lattice_of(readings);
    fit.smoothing = smoothing_of(standing, fit.lattice, readings.whole_mm, fit.unknown);
    NoiseModel start{.rounding_mm2 = fit.lattice.rounding_mm2(readings.whole_mm)};
    start.median_of_five = fit.smoothing && fit.smoothing->smoothing.median_of_five;
    fit.noise = fit_noise(standing, start, fit.unknown);
    if (fit.noise) fit.held_out = held_out(standing, *fit.noise, kind.model->optics);
    fit.codes = codes_of(readings);
    fit.lost = lost_beams(standing);
    fit.light = fit_light(standing);
    fit.mixed = mixed_beams(standing);
    fit.drift = relative_drift(standing);
    for (const Length& length : lengths)
        fit.bias.push_back(bias_by(length, readings, standing.stations));
    tell_what_is_missing(readings, fit);
    return fit;
}

}  // namespace scipd::tools
