// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/compare/comparison_words.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/formatted.h"

namespace scipd::tools::comparing {
namespace {

std::string steps_text(const Difference& difference) {
    if (difference.from == difference.to) return formatted("step %d", difference.from);
    return formatted("steps %d–%d", difference.from, difference.to);
}

/// The size of an effect that lies on one side of 0.
Interval without_sign(const Interval& within) {
    return within.low < 0 ? Interval{-within.high, -within.low} : within;
}

/// Without a sign; the interval is of the same sign.
std::string length_text(double length_mm, const Interval& within_mm) {
    const bool far = std::abs(length_mm) >= 100;
    const double unit = far ? 1e3 : 1;
    const Interval within = without_sign(within_mm);
    return formatted(far ? "%.2f m (%.2f to %.2f)" : "%.1f mm (%.1f to %.1f)",
                     std::abs(length_mm) / unit, within.low / unit, within.high / unit);
}

std::string percent_text(double share) {
    return formatted(std::abs(share) < 0.1 ? "%.1f %%" : "%.0f %%", 100 * share);
}

std::string code_text(Code code) {
    return (code >= 0 ? "code " : "") + name_of_code(code);
}

/// "code 1 in 30 % instead of 0 %, code 7 in 0 % instead of 31 %"
std::string codes_text(const Difference& difference) {
    std::string text;
    for (const auto& [code, share] : difference.codes_b) {
        if (!text.empty()) text += ", ";
        text += code_text(code) + " in " + percent_text(share) + " instead of " +
                percent_text(difference.codes_a.at(code));
    }
    return text;
}

/// Without a factor where A hardly spreads: to divide by next to nothing tells nothing.
std::string spread_text(const Difference& difference) {
    constexpr double least_mm = 0.1;
    if (difference.a < least_mm)
        return formatted(" spread by %.1f mm instead of %.1f mm", difference.b, difference.a);
    return formatted(" spread %.2g times as much: %.1f mm instead of %.1f mm",
                     difference.b / difference.a, difference.b, difference.a);
}

/// " by 12 %: 560 instead of 500"; nothing has no per cent.
std::string brightness_text(const Difference& difference) {
    const double by = std::abs(difference.difference() / difference.a);
    return (std::isfinite(by) ? " by " + percent_text(by) : "") +
           formatted(": %.0f instead of %.0f", difference.b, difference.a);
}

std::string known(const char* pattern, const std::optional<double>& value) {
    return value && std::isfinite(*value) ? formatted(pattern, *value) : "";
}

Row row_of(const char* what, const char* pattern, const std::optional<double>& a,
           const std::optional<double>& b) {
    return {what, known(pattern, a), known(pattern, b), "", ""};
}

std::string within_text(const char* pattern, double value, const Interval& within) {
    return std::isfinite(value) && std::isfinite(within.low)
               ? formatted(pattern, value, within.low, within.high)
               : "";
}

std::string floor_text(double floor_mm) {
    return std::isfinite(floor_mm) ? formatted("%.2f mm", floor_mm) : "not known";
}

std::string clock_text(const std::optional<ClockRate>& clock) {
    return clock ? formatted("%+.0f ppm (± %.0f)", clock->ppm, clock->uncertainty_ppm) : "";
}

}  // namespace

std::string share_list(const CodeShares& shares) {
    constexpr std::size_t most = 4;
    std::vector<std::pair<double, Code>> sorted;
    for (const auto& [code, share] : shares)
        sorted.emplace_back(-share, code);
    std::ranges::sort(sorted);
    std::string text;
    for (std::size_t i = 0; i < std::min(sorted.size(), most); ++i) {
        if (i > 0) text += ", ";
        text += name_of_code(sorted[i].second) + ": " + percent_text(-sorted[i].first);
    }
    return sorted.size() > most ? text + ", …" : text.empty() ? "none" : text;
}

std::string sentence_of(const Difference& difference) {
    const double by = difference.difference();
    switch (difference.what) {
        case What::mean:
            return steps_text(difference) + (by < 0 ? " nearer by " : " farther by ") +
                   length_text(by, difference.by);
        case What::sd:
            return steps_text(difference) + spread_text(difference);
        case What::codes:
            return steps_text(difference) + ": " + codes_text(difference);
        case What::intensity:
            return steps_text(difference) + (by < 0 ? " darker" : " brighter") +
                   brightness_text(difference);
        case What::neighbours:
            return "neighbouring steps share " + std::string(by < 0 ? "less" : "more") +
                   formatted(" of their noise: a correlation of %.2f instead of %.2f", difference.b,
                             difference.a);
        case What::rate:
            return formatted("%.3f scans a second instead of %.3f", difference.b, difference.a);
        case What::clock:
            return formatted("the clock runs %s by %.0f ppm (%.0f to %.0f)",
                             by < 0 ? "slower" : "faster", std::abs(by),
                             without_sign(difference.by).low, without_sign(difference.by).high);
    }
    return "";
}

std::string verdict_of(const Comparison& comparison) {
    const std::size_t scans = std::min(comparison.a.scans, comparison.b.scans);
    if (comparison.alike())
        return "They are alike, as far as " + std::to_string(scans) + " scans can tell.";
    const std::size_t things = comparison.differ.size();
    return "They differ in " + std::to_string(things) + (things == 1 ? " thing:" : " things:");
}

std::string missing_floor(const Comparison& comparison) {
    if (std::isfinite(comparison.floor.mean_mm)) return {};
    return "The detection limit is not known: no step of A sees a single static surface. Compare "
           "scans of a stationary scanner.";
}

std::string place_of(const Comparison& comparison) {
    if (!comparison.by_angle)
        return "The angles of one side are unknown, so steps are compared by their numbers.";
    if (!comparison.motion) return "B is taken to be at A's pose.";
    const auto& motion = *comparison.motion;
    if (motion == PlanarMotion{}) return "B is at A's pose, within the accuracy of the scans.";
    return formatted(
        "B is %.1f mm %s and %.1f mm to the %s of A, turned by %+.2f°; this is compensated.",
        std::abs(motion.shift_mm.x), motion.shift_mm.x < 0 ? "behind" : "ahead",
        std::abs(motion.shift_mm.y), motion.shift_mm.y < 0 ? "right" : "left",
        motion.turn_rad * 180 / std::numbers::pi);
}

std::string scanner_of(const Side& side) {
    std::string text = side.identity.model.empty() ? "a scanner" : side.identity.model;
    if (!side.identity.serial.empty()) text += "  ·  serial " + side.identity.serial;
    if (!side.identity.firmware.empty()) text += "  ·  firmware " + side.identity.firmware;
    text += formatted("  ·  %zu scans of %zu steps", side.scans, side.steps);
    if (side.doubles > 0) text += formatted("; %zu came twice", side.doubles);
    if (side.odd_ones > 0) text += formatted("; %zu others dropped", side.odd_ones);
    return text;
}

std::vector<Row> overview_of(const Comparison& comparison) {
    const Side& a = comparison.a;
    const Side& b = comparison.b;
    const auto within = "%+.2f mm (%+.2f to %+.2f)";
    return {
        {"range", "", "", within_text(within, comparison.mean_mm, comparison.mean_within_mm),
         floor_text(comparison.floor.mean_mm)},
        {"standard deviation", known("%.2f mm", a.sd_mm), known("%.2f mm", b.sd_mm),
         within_text(within, b.sd_mm - a.sd_mm, comparison.sd_within_mm),
         floor_text(comparison.floor.sd_mm)},
        {"neighbours", known("%.2f", a.neighbours), known("%.2f", b.neighbours),
         within_text("%+.2f (%+.2f to %+.2f)", b.neighbours - a.neighbours,
                     comparison.neighbours_within),
         ""},
        row_of("mixed pixels", "%.2f %%", 100 * a.mixed, 100 * b.mixed),
        {"codes", share_list(a.codes), share_list(b.codes), "", ""},
        row_of("intensity", "%.0f", a.intensity, b.intensity),
        row_of("scans a second", "%.3f", a.stamps.rate_hz, b.stamps.rate_hz),
        row_of("jitter", "%.2f ms", a.stamps.jitter_ms, b.stamps.jitter_ms),
        row_of("latency", "%.1f ms", a.latency_ms, b.latency_ms),
        row_of("extra delay (above the minimum)", "%.2f ms", a.stamps.delay_ms, b.stamps.delay_ms),
        {"clock", clock_text(a.stamps.clock), clock_text(b.stamps.clock), "", ""},
    };
}

std::vector<Difference> weightiest_first(std::vector<Difference> differences) {
    const auto weight = [](const Difference& difference) {
        if (!difference.is_of_steps()) return 1e9;
        const auto steps = static_cast<double>(difference.last_pair - difference.first_pair + 1);
        const double effect = std::isfinite(difference.effect) ? std::abs(difference.effect) : 3;
        return steps * std::min(effect, 30.0);
    };
    std::ranges::stable_sort(differences, {}, [&](const Difference& one) { return -weight(one); });
    return differences;
}

}  // namespace scipd::tools::comparing
