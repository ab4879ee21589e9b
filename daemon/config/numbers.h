// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Numbers from the text that a user wrote, with their bounds, as config_values are: every function
// but the first throws std::invalid_argument, saying what to do. Any thread; nothing shared.
#pragma once

#include <charconv>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>
#include <system_error>

namespace scipd::daemon {

/// Nothing where it is none, or does not fit.
template <class Integer>
std::optional<Integer> parse_integer(std::string_view text) {
    Integer value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return {};
    return value;
}

/// From least to most, both inclusive.
int parse_whole(std::string_view text, int least, int most);

/// How much too fast a device's clock runs, parts per million.
double parse_ppm(std::string_view text);
/// What a device's clock can show: 24 bits of milliseconds.
std::uint32_t parse_device_time(std::string_view text);

/// Milliseconds, up to 10 minutes: what a device takes for something.
std::chrono::nanoseconds parse_period(std::string_view text);
/// Milliseconds, up to 10 seconds: what a link adds.
std::chrono::nanoseconds parse_link_delay(std::string_view text);
/// Seconds, 1 to 3600, or 0: when a client that does not acknowledge anything is gone.
std::chrono::nanoseconds parse_dead_after(std::string_view text);
/// Milliseconds, up to 900: how long scans wait for poses. A daemon that is later by a second gives
/// a scan up.
std::chrono::nanoseconds parse_wait(std::string_view text);
/// Seconds, up to an hour: after which a stream of poses is stale.
std::chrono::nanoseconds parse_stale(std::string_view text);
/// Hz, 1 to 1000, as what lies between. Below, a measurement's poses could be forgotten when it is
/// asked for.
std::chrono::nanoseconds parse_rate(std::string_view text);
/// Degrees that a pinhole can see, in radians.
double parse_view(std::string_view text);
/// Degrees of a cone from rim to rim, up to half the space, in radians.
double parse_cone(std::string_view text);
/// Metres per second: nothing moves faster.
double parse_fastest(std::string_view text);
/// How much faster than its stamps a trajectory is played, 0.001 to 1000.
double parse_speed(std::string_view text);
/// Bits per second of a serial line.
int parse_baud(std::string_view text);
/// Bytes in one piece; 0: all.
int parse_split(std::string_view text);

/// A depth buffer's pixels from one beam to the next, 1 to 16.
double parse_oversample(std::string_view text);
/// Radians from degrees, 10 to 120: what a depth buffer draws in one pass.
double parse_pass(std::string_view text);

double parse_metres(std::string_view text);
double parse_radians(std::string_view text);
/// Metres, not negative.
double parse_length(std::string_view text);
/// Of a whole, 0 to 1.
double parse_share(std::string_view text);

}  // namespace scipd::daemon
