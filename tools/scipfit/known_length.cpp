// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/known_length.h"

#include <charconv>
#include <cmath>
#include <optional>

#include "sim/text/quote.h"
#include "sim/text/text_number.h"
#include "tools/formatted.h"
#include "tools/options.h"

namespace scipd::tools {
namespace {

/// A tape that is read by hand.
constexpr double tape_mm = 1.0;
/// More than any data sheet allows.
constexpr double most_mm = 100.0;
constexpr double most_share = 0.05;

const Beam& beam_at(int step, const ScanTable& readings, const std::vector<Station>& stations) {
    const int index = (step - readings.step_of(0)) / readings.directions.cluster;
    if (step < readings.step_of(0) || static_cast<std::size_t>(index) >= readings.beams)
        throw WrongInput("--length: step " + std::to_string(step) + " is not recorded");
    const Beam* const beam =
        stations.empty() ? nullptr : &stations[0].beams[static_cast<std::size_t>(index)];
    if (beam == nullptr || !beam->still)
        throw WrongInput("--length: step " + std::to_string(step) +
                         " sees nothing static; name another");
    return *beam;
}

std::optional<int> whole_number(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

}  // namespace

BiasAt bias_by(const Length& length, const ScanTable& readings,
               const std::vector<Station>& stations) {
    const Beam& a = beam_at(length.from_step, readings, stations);
    const Beam& b = beam_at(length.to_step, readings, stations);
    // The law of cosines in x, what both are read too far:
    // L² = (a-x)² + (b-x)² - 2 (a-x)(b-x) cos w, which is a square equation.
    const double w =
        readings.beam_rad() * (length.to_step - length.from_step) / readings.directions.cluster;
    const double k = 2.0 * (1.0 - std::cos(w));
    const double sum = a.mean_mm + b.mean_mm;
    const double target = 1000.0 * length.metres;
    const double c = a.mean_mm * a.mean_mm + b.mean_mm * b.mean_mm -
                     2.0 * a.mean_mm * b.mean_mm * std::cos(w) - target * target;
    const double root = 0.25 * sum * sum * k * k - k * c;
    if (k < 0.01 || root < 0.0)
        throw WrongInput("--length: steps " + std::to_string(length.from_step) + " and " +
                         std::to_string(length.to_step) +
                         " do not tell; name two that are far apart, and the length in metres");
    const double bias_mm = (0.5 * sum * k - std::sqrt(root)) / k;
    // No scanner errs like this: the length is of something else, or in another unit.
    if (std::abs(bias_mm) > most_mm + most_share * target) {
        const double seen_mm = std::sqrt(std::max(0.0, c + target * target));
        throw WrongInput(
            formatted("--length: steps %d and %d see %.3f m between them, not %.3f m; "
                      "give the length in metres, and the steps that see its ends",
                      length.from_step, length.to_step, seen_mm / 1000, length.metres));
    }
    // dL/dx is 2 where the two look opposite ways.
    const double per_mm = std::sqrt(root) / target;
    const double noise2 = a.variance_mm2 / static_cast<double>(a.count) +
                          b.variance_mm2 / static_cast<double>(b.count);
    const double half = 1.96 * std::sqrt(tape_mm * tape_mm + noise2) / per_mm;
    return {0.5 * sum,
            {bias_mm, bias_mm - half, bias_mm + half},
            formatted("%.3f m from step %d to step %d", length.metres, length.from_step,
                      length.to_step)};
}

Length parse_length_between(const std::string& text) {
    const auto colon = text.find(':');
    const auto equals = text.find('=');
    if (colon != text.npos && equals != text.npos && colon < equals) {
        std::string metres = text.substr(equals + 1);
        if (metres.ends_with('m')) metres.pop_back();
        const auto from = whole_number(text.substr(0, colon));
        const auto to = whole_number(text.substr(colon + 1, equals - colon - 1));
        const auto length = sim::parse_number(metres);
        if (from && to && length && *length > 0.0) return {*from, *to, *length};
    }
    throw WrongInput("--length: must be STEP:STEP=METRES, such as 180:900=3.2m, not " +
                     sim::quote(text));
}

}  // namespace scipd::tools
