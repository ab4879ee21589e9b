// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <cmath>
#include <numbers>
#include <string_view>

#include <nlohmann/json.hpp>

#include "tools/scipcat/compare/comparison_report.h"
#include "tools/scipcat/compare/comparison_words.h"

namespace scipd::tools::comparing {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json number(const std::optional<double>& value) {
    return value ? number(*value) : Json(nullptr);
}

Json words(const std::string& text) {
    return text.empty() ? Json(nullptr) : Json(text);
}

Json interval(const Interval& within) {
    return {number(within.low), number(within.high)};
}

Json shares_json(const CodeShares& shares) {
    Json object = Json::object();
    for (const auto& [code, share] : shares)
        object[name_of_code(code)] = share;
    return object;
}

Json clock_json(const std::optional<ClockRate>& clock) {
    if (!clock) return nullptr;
    return {{"ppm", clock->ppm}, {"uncertainty_ppm", clock->uncertainty_ppm}};
}

Json side_json(const Side& side) {
    return {
        {"name", side.name},
        {"model", words(side.identity.model)},
        {"serial", words(side.identity.serial)},
        {"firmware", words(side.identity.firmware)},
        {"scans", side.scans},
        {"steps", side.steps},
        {"doubles", side.doubles},
        {"left_out", side.odd_ones},
        {"intensity", number(side.intensity)},
        {"mixed", side.mixed},
        {"rate_hz", number(side.stamps.rate_hz)},
        {"jitter_ms", number(side.stamps.jitter_ms)},
        {"latency_ms", number(side.latency_ms)},
        {"delay_ms", number(side.stamps.delay_ms)},
        {"clock", clock_json(side.stamps.clock)},
    };
}

std::string_view name_of(What what) {
    switch (what) {
        case What::mean:
            return "mean";
        case What::sd:
            return "sd";
        case What::codes:
            return "codes";
        case What::intensity:
            return "intensity";
        case What::neighbours:
            return "neighbours";
        case What::rate:
            return "rate";
        case What::clock:
            return "clock";
    }
    return "";
}

Json difference_json(const Difference& difference) {
    Json object;
    if (difference.is_of_steps()) {
        object["from"] = difference.from;
        object["to"] = difference.to;
    }
    object["what"] = name_of(difference.what);
    if (difference.what == What::clock) object["ppm"] = difference.difference();
    const bool codes = difference.what == What::codes;
    object["a"] = codes ? shares_json(difference.codes_a) : number(difference.a);
    object["b"] = codes ? shares_json(difference.codes_b) : number(difference.b);
    object["within"] = interval(difference.by);
    object["effect"] = number(difference.effect);
    return object;
}

Json motion_json(const Comparison& comparison) {
    if (!comparison.motion) return nullptr;
    const PlanarMotion& motion = *comparison.motion;
    return {{"x_mm", motion.shift_mm.x},
            {"y_mm", motion.shift_mm.y},
            {"yaw_deg", motion.turn_rad * 180 / std::numbers::pi}};
}

Json beams_json(const Comparison& comparison) {
    Json beams = Json::array();
    for (std::size_t i = 0; i < comparison.pairs.size(); ++i) {
        const BeamPair& pair = comparison.pairs[i];
        const BeamStatistics& a = comparison.a.beams[pair.a];
        const BeamStatistics& b = comparison.b.beams[pair.b];
        beams.push_back({{"step", comparison.steps[i]},
                         {"mean_a_mm", number(a.mean_mm)},
                         {"mean_b_mm", number(b.mean_mm + pair.nearer_mm)},
                         {"sd_a_mm", number(a.sd_mm)},
                         {"sd_b_mm", number(b.sd_mm)},
                         {"share_a", a.share},
                         {"share_b", b.share},
                         {"intensity_a", number(a.intensity)},
                         {"intensity_b", number(b.intensity)},
                         {"compared", pair.comparable}});
    }
    return beams;
}

}  // namespace

std::string as_json(const Comparison& comparison) {
    Json document{{"a", side_json(comparison.a)},
                  {"b", side_json(comparison.b)},
                  {"pose", motion_json(comparison)},
                  {"mean_mm", number(comparison.mean_mm)},
                  {"mean_within_mm", interval(comparison.mean_within_mm)},
                  {"sd_a_mm", number(comparison.a.sd_mm)},
                  {"sd_b_mm", number(comparison.b.sd_mm)},
                  {"sd_within_mm", interval(comparison.sd_within_mm)},
                  {"neighbours_a", number(comparison.a.neighbours)},
                  {"neighbours_b", number(comparison.b.neighbours)},
                  {"codes_a", shares_json(comparison.a.codes)},
                  {"codes_b", shares_json(comparison.b.codes)},
                  {"floor",
                   {{"mean_mm", number(comparison.floor.mean_mm)},
                    {"sd_mm", number(comparison.floor.sd_mm)},
                    {"why", words(missing_floor(comparison))}}},
                  {"differ", Json::array()},
                  {"verdict", comparison.alike() ? "alike" : "differ"}};
    for (const Difference& difference : comparison.differ)
        document["differ"].push_back(difference_json(difference));
    document["beams"] = beams_json(comparison);
    return document.dump(2, ' ', true, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace scipd::tools::comparing
