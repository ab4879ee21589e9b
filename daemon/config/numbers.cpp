// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/numbers.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "daemon/models/profile_check.h"
#include "sim/text/quote.h"
#include "sim/world/reach.h"

namespace scipd::daemon {

using sim::Expected;

namespace {

using sim::quote;
using sim::refuse;
using std::chrono::nanoseconds;

constexpr double above_zero = std::numeric_limits<double>::denorm_min();
constexpr double angle_limit_rad = 1e6;
constexpr double largest_ppm = 10'000.0;
constexpr int longest_phase_ms = 1000;
constexpr int largest_device_time_ms = (1 << 24) - 1;
constexpr int longest_period_ms = 600'000;
constexpr int longest_link_delay_ms = 10'000;
constexpr int longest_wait_ms = 900;
constexpr int widest_view_deg = 170;
constexpr int widest_cone_deg = 180;
constexpr int largest_piece = 65'536;

Expected<double> parse_number(std::string_view text) {
    const auto digits = text.substr(text.starts_with('+') ? 1 : 0);
    double value = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value))
        return refuse("must be a number, not " + quote(text));
    return value;
}

/// A number from least to most; `rule` tells a user what it must do.
Expected<double> parse_within(std::string_view text, double least, double most,
                              const std::string& rule) {
    const auto number = parse_number(text);
    if (number && (*number < least || *number > most))
        return refuse("must " + rule + ", not " + quote(text));
    return number;
}

nanoseconds from_seconds(double duration_s) {
    return std::chrono::round<nanoseconds>(std::chrono::duration<double>(duration_s));
}

nanoseconds from_milliseconds(double duration_ms) {
    return std::chrono::round<nanoseconds>(std::chrono::duration<double, std::milli>(duration_ms));
}

Expected<nanoseconds> parse_milliseconds(std::string_view text, int most) {
    return parse_within(text, 0.0, most, "be 0 to " + std::to_string(most) + " ms")
        .map(from_milliseconds);
}

/// Degrees, in radians.
Expected<double> parse_opening(std::string_view text, int widest_deg) {
    return parse_within(text, above_zero, widest_deg,
                        "be more than 0 and up to " + std::to_string(widest_deg) + " degrees")
        .map([](double angle_deg) { return angle_deg * std::numbers::pi / 180.0; });
}

}  // namespace

Expected<int> parse_whole(std::string_view text, int least, int most) {
    const auto number = parse_integer<int>(text);
    if (!number || *number < least || *number > most) {
        return refuse("must be a whole number from " + std::to_string(least) + " to " +
                      std::to_string(most) + ", not " + quote(text));
    }
    return *number;
}

Expected<double> parse_ppm(std::string_view text) {
    return parse_within(text, -largest_ppm, largest_ppm, "lie within 10000 ppm");
}

Expected<std::uint32_t> parse_device_time(std::string_view text) {
    return parse_whole(text, 0, largest_device_time_ms).map([](int time_ms) {
        return static_cast<std::uint32_t>(time_ms);
    });
}

Expected<nanoseconds> parse_phase(std::string_view text) {
    return parse_milliseconds(text, longest_phase_ms);
}

Expected<nanoseconds> parse_period(std::string_view text) {
    return parse_milliseconds(text, longest_period_ms);
}

Expected<nanoseconds> parse_link_delay(std::string_view text) {
    return parse_milliseconds(text, longest_link_delay_ms);
}

Expected<nanoseconds> parse_dead_after(std::string_view text) {
    const auto duration_s = parse_number(text);
    if (duration_s && *duration_s != 0.0 && (*duration_s < 1.0 || *duration_s > 3600.0))
        return refuse("must be 1 to 3600 s, or 0 for never, not " + quote(text));
    return duration_s.map(from_seconds);
}

Expected<nanoseconds> parse_wait(std::string_view text) {
    return parse_milliseconds(text, longest_wait_ms);
}

Expected<nanoseconds> parse_stale(std::string_view text) {
    return parse_within(text, above_zero, 3600.0, "be more than 0 and up to 3600 s")
        .map(from_seconds);
}

Expected<nanoseconds> parse_span(std::string_view text) {
    return parse_within(text, 0.0, 1e6, "be 0 to 1000000 s").map(from_seconds);
}

Expected<nanoseconds> parse_rate(std::string_view text) {
    return parse_within(text, 1.0, 1000.0, "be 1 to 1000 Hz").map([](double rate_hz) {
        return from_seconds(1.0 / rate_hz);
    });
}

Expected<double> parse_view(std::string_view text) {
    return parse_opening(text, widest_view_deg);
}

Expected<double> parse_cone(std::string_view text) {
    return parse_opening(text, widest_cone_deg);
}

Expected<double> parse_fastest(std::string_view text) {
    return parse_within(text, above_zero, 1e6, "be more than 0 and up to 1e6 m/s");
}

Expected<double> parse_speed(std::string_view text) {
    return parse_within(text, 0.001, 1000.0, "be 0.001 to 1000");
}

Expected<int> parse_baud(std::string_view text) {
    return parse_whole(text, slowest_bit_rate, fastest_bit_rate);
}

Expected<int> parse_split(std::string_view text) {
    return parse_whole(text, 0, largest_piece);
}

Expected<double> parse_oversample(std::string_view text) {
    return parse_within(text, 1.0, 16.0, "be 1 to 16");
}

Expected<double> parse_pass(std::string_view text) {
    return parse_within(text, 10.0, 120.0, "be 10 to 120 degrees").map([](double width_deg) {
        return width_deg / 180.0 * std::numbers::pi;
    });
}

Expected<double> parse_metres(std::string_view text) {
    return parse_within(text, -sim::position_limit_m, sim::position_limit_m, "lie within 1e7 m");
}

Expected<double> parse_radians(std::string_view text) {
    return parse_within(text, -angle_limit_rad, angle_limit_rad, "lie within 1e6 rad");
}

Expected<double> parse_length(std::string_view text) {
    const auto length_m = parse_metres(text);
    if (length_m && *length_m < 0.0) return refuse("must be 0 or more, not " + quote(text));
    return length_m;
}

Expected<double> parse_share(std::string_view text) {
    return parse_within(text, 0.0, 1.0, "be 0 to 1");
}

Expected<double> parse_noise_factor(std::string_view text) {
    return parse_within(text, 0.0, most_noise_factor, "be 0 to 100");
}

}  // namespace scipd::daemon
