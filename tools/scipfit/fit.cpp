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
        unknown.push_back({"neighbours", why, "50 or more static scans of walls"});
        return std::nullopt;
    };
    if (scans < least_scans_for_pairs)
        return leave("the scanner is stationary for " + std::to_string(scans) + " scans");
    const double place_mm = std::max(lattice.spacing_mm, whole_mm ? 1.0 : 0.0);
    SmoothingFit fit =
        fit_smoothing(standing.stations, standing.sums, lattice.rounding_mm2(whole_mm), place_mm);
    if (fit.pairs < least_pairs)
        return leave(std::to_string(fit.pairs) + " pairs of beams see one static surface");
    if (scans < least_scans_for_after)
        unknown.push_back({"scans", "what scans share with the next one takes 80 scans to be seen",
                           "a longer recording of a stationary scanner"});
    return fit;
}

void tell_what_one_place_cannot(const Fit& fit, Unknowns& unknown) {
    if (fit.calibration) {
        unknown.insert(unknown.end(), fit.calibration->unknown.begin(),
                       fit.calibration->unknown.end());
    } else {
        if (fit.bias.empty())
            unknown.push_back(
                {"offset", "where a wall is, and what the scanner reads too far, look the same",
                 std::string("--length STEP:STEP=METRES, --world, or ") + what_tells_the_offset});
        unknown.push_back({"scale", "a larger room looks the same",
                           "--world, or lengths that were measured at several ranges"});
    }
    if (fit.face_light)
        unknown.insert(unknown.end(), fit.face_light->unknown.begin(),
                       fit.face_light->unknown.end());
    const bool by_world = fit.calibration && fit.calibration->by_world;
    unknown.push_back({"angle_offset",
                       by_world ? "only its sum with the yaw of --pose shows"
                                : "a room that is turned looks the same",
                       "a pose whose yaw is known better than the scanner's"});
    if (!fit.light.by_range.empty())
        unknown.push_back({"reflectance", "only its product with the gain of the receiver shows",
                           "a target whose reflectance is known"});
    unknown.push_back({"warm_up", "how long the scanner was on before is not known",
                       "a recording from the cold start on, before a target that does not move"});
}

void tell_what_is_missing(const ScanTable& readings, Fit& fit) {
    Unknowns& unknown = fit.unknown;
    if (!fit.kind.known)
        unknown.push_back({"model", fit.kind.from, "--model, or a recording by scipcat record"});
    if (!readings.has_intensities())
        unknown.push_back(
            {"i0", "the recording has no intensities", "scipcat record with --intensity"});
    if (!readings.has_codes)
        unknown.push_back(
            {"codes", "the recording has none of the scanner's codes", "scipcat record"});
    if (!fit.lattice.known)
        unknown.push_back({"lattice",
                           "too few distances lie close together, or they are not evenly apart",
                           "more static scans"});
    if (!fit.mixed)
        unknown.push_back({"mixed_beams", "fewer than eight edges are 0.15 to 1 m deep",
                           "boxes in front of walls"});
    if (!fit.drift) unknown.push_back({"drift", "too few beams are static", "a longer recording"});
    tell_what_one_place_cannot(fit, unknown);
}

/// The intensity of a white wall by range, if the surfaces are as the world says.
void take_light(const FaceLight& light, const KnownWorld& world, int wavelength_nm, LightFit& fit) {
    double logs = 0.0;
    double beams = 0.0;
    for (const SurfaceLight& one : light.surfaces) {
        const double brightness = world.brightness_of(one.surface, wavelength_nm);
        if (!one.intensity || brightness <= 0.0) continue;
        const double count = static_cast<double>(one.beams);
        logs += count * std::log(one.intensity->value / brightness);
        beams += count;
    }
    if (beams == 0.0 || light.by_range.empty()) return;
    const double white = std::exp(logs / beams);
    fit.by_range.clear();
    for (const RangeLight& one : light.by_range)
        fit.by_range.push_back({one.range_mm, white * one.times, static_cast<std::size_t>(beams)});
    fit.of_what = "of a white wall, if all surfaces are as the world says";
}

/// By lengths that were measured; else by the world; else by a room that several stations share.
void find_bias(const Standing& standing, const Given& given, Fit& fit) {
    for (const Length& length : given.lengths)
        fit.bias.push_back(bias_by(length, *standing.readings, standing.stations));
    if (!given.lengths.empty()) return;
    if (given.world != nullptr)
        fit.calibration = calibrate_in(*given.world, standing, given.places);
    else if (const auto room = shared_room(standing))
        fit.calibration = calibrate_in(*room, standing);
    if (!fit.calibration) return;
    fit.bias = fit.calibration->curve;
    fit.face_light = light_of_faces(*fit.calibration);
    if (!fit.face_light) return;
    if (given.world != nullptr)
        take_light(*fit.face_light, *given.world, fit.kind.model->optics.receiver.wavelength_nm,
                   fit.light);
    for (SurfaceLight& one : fit.face_light->surfaces)
        one.name = given.world != nullptr ? given.world->name_of(one.surface)
                                          : "wall " + std::to_string(one.surface + 1);
}

}  // namespace

Standing look_at(const ScanTable& readings) {
    Standing standing{&readings, stations_of(readings), {}};
    for (const Station& station : standing.stations)
        standing.sums.push_back(sums_of(readings, station));
    return standing;
}

Fit fit_scanner(const Standing& standing, const Kind& kind, const Given& given) {
    const ScanTable& readings = *standing.readings;
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
    find_bias(standing, given, fit);
    tell_what_is_missing(readings, fit);
    return fit;
}

}  // namespace scipd::tools
