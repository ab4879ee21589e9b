// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <cmath>
#include <string>

#include "tools/scipfit/fit_report.h"

namespace scipd::tools {
namespace {

using Json = nlohmann::ordered_json;

/// Six figures: none of these is known better.
double rounded(double value) {
    if (value == 0.0) return 0.0;
    const double scale = std::pow(10.0, 5.0 - std::floor(std::log10(std::abs(value))));
    return std::round(value * scale) / scale;
}

Json as_json(const Interval& interval) {
    return {{"value", rounded(interval.value)},
            {"low", rounded(interval.low)},
            {"high", rounded(interval.high)}};
}

Json sigma_json(const NoiseFit& noise) {
    Json sigma{{"law", noise.model.by_intensity ? "intensity" : "range"},
               {"s0_mm", noise.model.by_intensity ? as_json(noise.s0_mm) : Json(nullptr)},
               {"i0", noise.model.by_intensity ? as_json(noise.i0) : Json(nullptr)},
               {"spread", rounded(noise.spread)}};
    for (std::size_t i = 0; i < noise.steps.size(); ++i)
        sigma["steps"].push_back({{"from_m", noise.model.steps[i].from_mm / 1000.0},
                                  {"sigma_mm", as_json(noise.steps[i])}});
    return sigma;
}

Json neighbours_json(const SmoothingFit& fit) {
    Json list = Json::array();
    for (const Interval& one : fit.beside)
        list.push_back(as_json(one));
    return list;
}

Json smoothing_json(const SmoothingFit& fit) {
    if (fit.smoothing.median_of_five) return {{"median_of_five", true}};
    return {{"next", rounded(fit.smoothing.next)},
            {"after_next", rounded(fit.smoothing.after_next)}};
}

Json codes_json(const CodeShares& codes) {
    Json shares = Json::object();
    for (const auto& [code, counts] : codes.codes)
        shares[std::to_string(code)] = rounded(counts.all() / codes.all.all());
    return shares;
}

template <class Part, class Shown>
Json known(const std::optional<Part>& part, const Shown& shown) {
    return part ? Json(shown(*part)) : Json(nullptr);
}

Json places_json(const Calibration& found) {
    Json places = Json::array();
    for (const auto& at : found.places) {
        places.push_back(nullptr);
        if (at)
            places.back() = {{"x_mm", as_json(at->x_mm)},
                             {"y_mm", as_json(at->y_mm)},
                             {"yaw_rad", as_json(at->yaw_rad)}};
    }
    return places;
}

Json bias_json(const Fit& fit) {
    if (fit.bias.empty() && !fit.calibration) return nullptr;
    Json points = Json::array();
    for (const BiasAt& one : fit.bias)
        points.push_back({{"range_m", rounded(one.range_mm / 1000.0)},
                          {"bias_mm", as_json(one.bias_mm)},
                          {"from", one.how}});
    Json bias{{"points", points}};
    if (!fit.calibration) return bias;
    const Calibration& found = *fit.calibration;
    bias["offset_mm"] = known(found.offset_mm, [](const Interval& one) { return as_json(one); });
    bias["scale_mm_per_m"] =
        known(found.scale_mm_per_m, [](const Interval& one) { return as_json(one); });
    bias["places"] = places_json(found);
    bias["spread_mm"] = rounded(found.spread_mm);
    return bias;
}

Json face_light_json(const FaceLight& light) {
    Json json{{"reference_m", rounded(light.reference_mm / 1000.0)},
              {"surfaces", Json::array()},
              {"incidence", Json::array()}};
    for (const SurfaceLight& one : light.surfaces)
        json["surfaces"].push_back(
            {{"name", one.name},
             {"beams", one.beams},
             {"intensity", one.intensity ? as_json(*one.intensity) : Json(nullptr)}});
    for (const IncidenceAt& one : light.incidence)
        json["incidence"].push_back(
            {{"angle_rad", one.incidence_rad}, {"share", as_json(one.share)}});
    return json;
}

Json light_json(const LightFit& light) {
    Json list = Json::array();
    for (const LightNoise& one : light.noise)
        list.push_back({{"intensity", rounded(one.intensity)}, {"share", as_json(one.share)}});
    return list;
}

Json held_out_json(const HeldOut& held_out) {
    return {{"coverage_95", rounded(held_out.coverage_95)},
            {"nll", rounded(held_out.nll)},
            {"nll_sheet", held_out.nll_sheet > 0.0 ? Json(rounded(held_out.nll_sheet)) : nullptr},
            {"nll_constant", rounded(held_out.nll_constant)},
            {"nll_per_beam", rounded(held_out.nll_per_beam)},
            {"readings", held_out.readings}};
}

Json unknown_json(const Unknowns& unknown) {
    Json list = Json::array();
    for (const Unknown& one : unknown)
        list.push_back(
            {{"parameter", one.parameter}, {"why", one.why}, {"would_tell", one.would_tell}});
    return list;
}

}  // namespace

nlohmann::ordered_json as_json(const Fit& fit) {
    constexpr std::size_t least_scans_for_after = 80;
    const bool after = fit.smoothing && fit.scans >= least_scans_for_after;
    return {
        {"model", fit.kind.model->profile.name + "@" + fit.kind.model->profile.release},
        {"model_known", fit.kind.known},
        {"sigma", known(fit.noise, sigma_json)},
        {"neighbours", known(fit.smoothing, neighbours_json)},
        {"smoothing", known(fit.smoothing, smoothing_json)},
        {"next_scan", after ? as_json(fit.smoothing->after) : Json(nullptr)},
        {"lattice_mm", fit.lattice.known ? Json(rounded(fit.lattice.spacing_mm)) : nullptr},
        {"codes", codes_json(fit.codes)},
        {"lost_share", fit.lost.readings > 0.0 ? Json(rounded(fit.lost.share)) : nullptr},
        {"intensity_noise", light_json(fit.light)},
        {"mixed_beams",
         known(fit.mixed, [](const MixedBeams& mixed) { return as_json(mixed.beams); })},
        {"drift_mm", known(fit.drift, [](const Drift& drift) { return as_json(drift.mm); })},
        {"bias", bias_json(fit)},
        {"surfaces", known(fit.face_light, face_light_json)},
        {"unknown", unknown_json(fit.unknown)},
        {"scans", fit.scans},
        {"beams", fit.beams},
        {"doubles", fit.doubles},
        {"held_out", known(fit.held_out, held_out_json)},
    };
}

}  // namespace scipd::tools
