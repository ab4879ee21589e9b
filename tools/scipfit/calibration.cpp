// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/calibration.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/formatted.h"
#include "tools/options.h"

namespace scipd::tools {
namespace {

constexpr int rounds = 3;
/// Knots for each doubling, as sim/sensor/unit_bias has them: what bends between knots would pass
/// for walls that are elsewhere.
constexpr int as_in_scipd = 4;
constexpr double believable_mm = 60.0;

/// Sights that look at what they are said to look at.
std::vector<Sight> near_ones(const std::vector<Sight>& sights, const PlaceFit& fit) {
    std::vector<Sight> near;
    std::ranges::copy_if(sights, std::back_inserter(near), [&](const Sight& sight) {
        return std::abs(off_mm(sight, fit)) < believable_mm;
    });
    return near;
}

PlaceFit begin_at(const Sights& sights, std::vector<FlatPose> places,
                  std::vector<PlaceError> errors) {
    PlaceFit fit;
    fit.given = places;
    fit.places = std::move(places);
    fit.errors = std::move(errors);
    fit.faces = sights.faces;
    fit.knots_mm = knots_for(sights, as_in_scipd);
    fit.bias_mm.assign(fit.knots_mm.size(), 0.0);
    return fit;
}

std::size_t stations_in(const std::vector<Sight>& sights) {
    std::vector<std::size_t> stations;
    for (const Sight& sight : sights)
        stations.push_back(sight.station);
    std::ranges::sort(stations);
    return static_cast<std::size_t>(std::ranges::unique(stations).begin() - stations.begin());
}

std::string how(const Calibration& calibration) {
    return formatted("%zu beams at %zu station%s", calibration.beams, calibration.stations,
                     calibration.stations == 1 ? "" : "s");
}

/// The ranges at which a curve is not known, in words.
std::string gaps_of(const PlaceKnowledge& known, const PlaceFit& fit) {
    std::string text;
    for (std::size_t i = 0; i < known.knots.size(); ++i) {
        if (!known.knots[i])
            text += formatted("%s%.2f", text.empty() ? "" : ", ", fit.knots_mm[i] / 1000.0);
    }
    return text;
}

/// One of a line, unless the curve is none.
void tell_of_line(const char* parameter, bool is_known, bool is_line, const Interval& interval,
                  const Unknown& otherwise, Calibration& result, std::optional<Interval>& told) {
    if (is_known && is_line)
        told = interval;
    else if (is_known)
        result.unknown.push_back(
            {parameter,
             "the bias is no line over the range: which line is nearest hangs on where walls are",
             "the bias itself, which is estimated range by range"});
    else
        result.unknown.push_back(otherwise);
}

void tell_line(const PlaceKnowledge& known, Calibration& result) {
    tell_of_line("offset", known.offset, known.is_line, known.offset_mm,
                 {"offset", "the scanner's pose and its range bias cannot be separated here",
                  what_tells_the_offset},
                 result, result.offset_mm);
    if (result.by_world)
        tell_of_line("scale", known.scale, known.is_line, known.scale_mm_per_m,
                     {"scale", "walls are too much at one range",
                      "walls that are near and walls that are far"},
                     result, result.scale_mm_per_m);
    else
        result.unknown.push_back({"scale", "a larger room looks the same", "--world, or a length"});
}

void tell_curve(const PlaceKnowledge& known, Calibration& result) {
    const PlaceFit& fit = result.fit;
    result.but_for_slope = !result.by_world && known.but_for_slope;
    for (std::size_t i = 0; i < known.knots.size(); ++i) {
        if (result.but_for_slope)
            result.curve.push_back({fit.knots_mm[i], known.bent_mm[i],
                                    how(result) + ", but for a slope over the range"});
        else if (result.by_world && known.knots[i])
            result.curve.push_back({fit.knots_mm[i], known.bias_mm[i], how(result)});
    }
    const std::string gaps = gaps_of(known, fit);
    if (!gaps.empty() && result.by_world && known.offset)
        result.unknown.push_back({"bias", "too little is seen at " + gaps + " m",
                                  "stations at which walls have these ranges"});
}

void tell_places(const PlaceKnowledge& known, Calibration& result) {
    for (std::size_t i = 0; i < known.places.size(); ++i)
        result.places.push_back(known.places[i] ? std::optional(known.at[i]) : std::nullopt);
    if (std::ranges::find(known.places, false) != known.places.end())
        result.unknown.push_back({"pose",
                                  "the visible surfaces do not determine the scanner's pose",
                                  "two walls that are not parallel"});
}

void finish(std::vector<Sight> sights, PlaceFit fit, Calibration& result) {
    constexpr std::size_t least_beams = 40;
    result.beams = sights.size();
    result.stations = stations_in(sights);
    result.spread_mm = fit.spread_mm;
    result.fit = std::move(fit);
    result.sights = std::move(sights);
    PlaceKnowledge known{.knots = {}, .places = {}};
    if (result.beams >= least_beams) known = knowledge_of(result.sights, result.fit);
    tell_line(known, result);
    tell_curve(known, result);
    if (result.by_world) tell_places(known, result);
}

}  // namespace

Calibration calibrate_in(KnownWorld& world, const Standing& standing,
                         const std::vector<FlatPose>& places) {
    constexpr double least_share = 0.5;
    Sights sights = world.look(standing, places);
    PlaceFit fit = begin_at(sights, places, std::vector(places.size(), by_hand));
    for (int i = 0; i < rounds; ++i) {
        refine(sights.list, fit);
        sights = world.look(standing, fit.places);
        fit.faces = sights.faces;
    }
    refine(sights.list, fit);
    std::vector<Sight> near = near_ones(sights.list, fit);
    if (static_cast<double>(near.size()) < least_share * static_cast<double>(sights.list.size()))
        throw WrongInput(
            formatted("--world: of %zu beams %zu see what the world has; are the poses right?",
                      sights.list.size(), near.size()));
    refine(near, fit);
    Calibration result{.by_world = true};
    finish(std::move(near), std::move(fit), result);
    return result;
}

Calibration calibrate_in(const SharedRoom& room, const Standing& standing) {
    constexpr PlaceError anywhere{.mm = std::numeric_limits<double>::infinity()};
    constexpr PlaceError exact{.mm = 1e-3, .yaw_rad = 1e-6};
    Sights sights = look(room, standing, room.places);
    std::vector<PlaceError> errors(room.places.size(), anywhere);
    for (std::size_t i = 0; i < errors.size(); ++i) {
        if (i == 0 || !room.placed[i]) errors[i] = exact;
    }
    PlaceFit fit = begin_at(sights, room.places, errors);
    fit.fits_faces = true;
    for (int i = 0; i < rounds; ++i) {
        refine(sights.list, fit);
        sights = look(room, standing, fit.places);
    }
    std::vector<Sight> near = near_ones(sights.list, fit);
    refine(near, fit);
    Calibration result;
    finish(std::move(near), std::move(fit), result);
    return result;
}

}  // namespace scipd::tools
