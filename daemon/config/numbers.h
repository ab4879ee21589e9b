// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Numbers from the text that a user wrote, each with its bounds. A Fault says what to do; its field
// is empty, since only the caller knows the key. Any thread; nothing shared.
#pragma once

#include <charconv>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>
#include <system_error>

#include "sim/expected.h"

namespace scipd::daemon {

/// Nothing where the text is no integer, or one too large for the type.
template <class Integer>
std::optional<Integer> parse_integer(std::string_view text) {
    Integer value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return {};
    return value;
}

/// A whole number from least to most, both inclusive.
sim::Expected<int> parse_whole(std::string_view text, int least, int most);

/// How much too fast a device's clock runs, parts per million.
sim::Expected<double> parse_ppm(std::string_view text);
/// What a device's clock can show: 24 bits of milliseconds.
sim::Expected<std::uint32_t> parse_device_time(std::string_view text);

/// Milliseconds, up to a second: when a mirror passes step 0.
sim::Expected<std::chrono::nanoseconds> parse_phase(std::string_view text);
/// Milliseconds, up to 10 minutes: how long a device takes for something.
sim::Expected<std::chrono::nanoseconds> parse_period(std::string_view text);
/// Milliseconds, up to 10 seconds: what a link adds.
sim::Expected<std::chrono::nanoseconds> parse_link_delay(std::string_view text);
/// Seconds, 1 to 3600, or 0 for never: after how long a client that acknowledges nothing counts as
/// gone.
sim::Expected<std::chrono::nanoseconds> parse_dead_after(std::string_view text);
/// Milliseconds, up to 900: how long scans wait for poses. It must be less than a second, after
/// which the daemon gives a scan up.
sim::Expected<std::chrono::nanoseconds> parse_wait(std::string_view text);
/// Seconds, up to an hour: after which a stream of poses is stale.
sim::Expected<std::chrono::nanoseconds> parse_stale(std::string_view text);
/// Seconds, up to 1e6: from one moment of a test to another.
sim::Expected<std::chrono::nanoseconds> parse_span(std::string_view text);
/// Hz, 1 to 1000, as the time from one measurement to the next. At less than 1 Hz the poses of a
/// measurement could be forgotten before it is asked for.
sim::Expected<std::chrono::nanoseconds> parse_rate(std::string_view text);
/// Degrees, more than 0 and up to 170, in radians: the view of a pinhole camera.
sim::Expected<double> parse_view(std::string_view text);
/// Degrees, more than 0 and up to 180, in radians: a cone from rim to rim.
sim::Expected<double> parse_cone(std::string_view text);
/// Metres per second, up to 1e6: a speed that nothing exceeds.
sim::Expected<double> parse_fastest(std::string_view text);
/// How much faster than its stamps a trajectory is played, 0.001 to 1000.
sim::Expected<double> parse_speed(std::string_view text);
/// Bits per second of a serial line.
sim::Expected<int> parse_baud(std::string_view text);
/// Bytes in one piece of a message; 0: the whole message.
sim::Expected<int> parse_split(std::string_view text);

/// A depth buffer's pixels from one beam to the next, 1 to 16.
sim::Expected<double> parse_oversample(std::string_view text);
/// Degrees, 10 to 120, in radians: how wide a view a depth buffer draws in one pass.
sim::Expected<double> parse_pass(std::string_view text);

sim::Expected<double> parse_metres(std::string_view text);
sim::Expected<double> parse_radians(std::string_view text);
/// Metres, not negative.
sim::Expected<double> parse_length(std::string_view text);
/// A part of a whole, 0 to 1.
sim::Expected<double> parse_share(std::string_view text);
/// How many times a model's noise, 0 to most_noise_factor.
sim::Expected<double> parse_noise_factor(std::string_view text);
inline constexpr double most_noise_factor = 100.0;

}  // namespace scipd::daemon
