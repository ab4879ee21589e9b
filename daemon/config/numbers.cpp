// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/numbers.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "daemon/models/profile_check.h"
#include "sim/text/quote.h"
#include "sim/world/reach.h"

namespace scipd::daemon {
namespace {

using sim::quote;

constexpr double angle_limit_rad = 1e6;
constexpr double largest_ppm = 10'000.0;
constexpr int largest_device_time_ms = (1 << 24) - 1;
constexpr int longest_period_ms = 600'000;
constexpr int longest_link_delay_ms = 10'000;
constexpr int longest_wait_ms = 900;
constexpr int widest_view_deg = 170;
constexpr int widest_cone_deg = 180;
constexpr int largest_piece = 65'536;

[[noreturn]] void refuse(const std::string& sentence) {
    throw std::invalid_argument(sentence);
}

double parse_number(std::string_view text) {
    const auto digits = text.substr(text.starts_with('+') ? 1 : 0);
    double value = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value)) {
        refuse("must be a number, not " + quote(text));
    }
    return value;
}

/// Not negative.
std::chrono::nanoseconds parse_milliseconds(std::string_view text, int most) {
    const double duration_ms = parse_number(text);
    if (duration_ms < 0.0 || duration_ms > most) {
        refuse("must be 0 to " + std::to_string(most) + " ms, not " + quote(text));
    }
    return std::chrono::round<std::chrono::nanoseconds>(
        std::chrono::duration<double, std::milli>(duration_ms));
}

/// Degrees, in radians.
double parse_opening(std::string_view text, int widest_deg) {
    const double angle_deg = parse_number(text);
    if (angle_deg <= 0.0 || angle_deg > widest_deg) {
        refuse("must be more than 0 and up to " + std::to_string(widest_deg) + " degrees, not " +
               quote(text));
    }
    return angle_deg * std::numbers::pi / 180.0;
}

}  // namespace

int parse_whole(std::string_view text, int least, int most) {
    const auto number = parse_integer<int>(text);
    if (!number || *number < least || *number > most) {
        refuse("must be a whole number from " + std::to_string(least) + " to " +
               std::to_string(most) + ", not " + quote(text));
    }
    return *number;
}

double parse_ppm(std::string_view text) {
    const double ppm = parse_number(text);
    if (std::abs(ppm) > largest_ppm) refuse("must lie within 10000 ppm, not " + quote(text));
    return ppm;
}

std::uint32_t parse_device_time(std::string_view text) {
    return static_cast<std::uint32_t>(parse_whole(text, 0, largest_device_time_ms));
}

std::chrono::nanoseconds parse_period(std::string_view text) {
    return parse_milliseconds(text, longest_period_ms);
}

std::chrono::nanoseconds parse_link_delay(std::string_view text) {
    return parse_milliseconds(text, longest_link_delay_ms);
}

std::chrono::nanoseconds parse_dead_after(std::string_view text) {
    const double seconds = parse_number(text);
    if (seconds != 0.0 && (seconds < 1.0 || seconds > 3600.0))
        refuse("must be 1 to 3600 s, or 0 for never, not " + quote(text));
    return std::chrono::round<std::chrono::nanoseconds>(std::chrono::duration<double>(seconds));
}

std::chrono::nanoseconds parse_wait(std::string_view text) {
    return parse_milliseconds(text, longest_wait_ms);
}

std::chrono::nanoseconds parse_stale(std::string_view text) {
    const double seconds = parse_number(text);
    if (seconds <= 0.0 || seconds > 3600.0)
        refuse("must be more than 0 and up to 3600 s, not " + quote(text));
    return std::chrono::round<std::chrono::nanoseconds>(std::chrono::duration<double>(seconds));
}

std::chrono::nanoseconds parse_rate(std::string_view text) {
    const double rate_hz = parse_number(text);
    if (rate_hz < 1.0 || rate_hz > 1000.0) refuse("must be 1 to 1000 Hz, not " + quote(text));
    return std::chrono::round<std::chrono::nanoseconds>(
        std::chrono::duration<double>(1.0 / rate_hz));
}

double parse_view(std::string_view text) {
    return parse_opening(text, widest_view_deg);
}

double parse_cone(std::string_view text) {
    return parse_opening(text, widest_cone_deg);
}

double parse_fastest(std::string_view text) {
    const double speed_mps = parse_number(text);
    if (speed_mps <= 0.0 || speed_mps > 1e6)
        refuse("must be more than 0 and up to 1e6 m/s, not " + quote(text));
    return speed_mps;
}

double parse_speed(std::string_view text) {
    const double factor = parse_number(text);
    if (factor < 0.001 || factor > 1000.0) refuse("must be 0.001 to 1000, not " + quote(text));
    return factor;
}

int parse_baud(std::string_view text) {
    return parse_whole(text, slowest_bit_rate, fastest_bit_rate);
}

int parse_split(std::string_view text) {
    return parse_whole(text, 0, largest_piece);
}

double parse_oversample(std::string_view text) {
    const double pixels = parse_number(text);
    if (pixels < 1.0 || pixels > 16.0) refuse("must be 1 to 16, not " + quote(text));
    return pixels;
}

double parse_pass(std::string_view text) {
    const double width_deg = parse_number(text);
    if (width_deg < 10.0 || width_deg > 120.0)
        refuse("must be 10 to 120 degrees, not " + quote(text));
    return width_deg / 180.0 * std::numbers::pi;
}

double parse_metres(std::string_view text) {
    const double length_m = parse_number(text);
    if (std::abs(length_m) > sim::position_limit_m)
        refuse("must lie within 1e7 m, not " + quote(text));
    return length_m;
}

double parse_radians(std::string_view text) {
    const double angle_rad = parse_number(text);
    if (std::abs(angle_rad) > angle_limit_rad)
        refuse("must lie within 1e6 rad, not " + quote(text));
    return angle_rad;
}

double parse_length(std::string_view text) {
    const double length_m = parse_metres(text);
    if (length_m < 0.0) refuse("must be 0 or more, not " + quote(text));
    return length_m;
}

double parse_share(std::string_view text) {
    const double share = parse_number(text);
    if (share < 0.0 || share > 1.0) refuse("must be 0 to 1, not " + quote(text));
    return share;
}

}  // namespace scipd::daemon
