// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One setting each, from the text that a user wrote, in a file or on the command line: the same
// rules and the same sentences for both. A Fault says what to do; its field is empty, since only
// the caller knows the key or the option. Relative paths are taken from `base`. Any thread; nothing
// shared.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "daemon/config/config.h"
#include "sim/expected.h"

namespace scipd::daemon {

/// The name of a robot or a sensor: letters, digits, _ - .
sim::Expected<std::string> parse_name(std::string_view text);

/// A model that the registry knows.
sim::Expected<Model> parse_model(std::string_view text);

/// auto, or a backend that this build has.
sim::Expected<std::string> parse_backend(std::string_view text);

/// nearest, interpolate or exact: how a depth buffer answers for a beam between its pixels.
sim::Expected<sim::BetweenPixels> parse_between_pixels(std::string_view text);

sim::Expected<sim::Accuracy> parse_accuracy(std::string_view text);
/// As it is written.
[[nodiscard]] std::string_view name_of(sim::Accuracy accuracy);
sim::Expected<sim::EchoChoice> parse_echo_choice(std::string_view text);
sim::Expected<Timing> parse_timing(std::string_view text);

/// A number of poses per sweep; nothing where the text is `beam`.
sim::Expected<std::optional<int>> parse_motion(std::string_view text);

/// scip2.0, scip1.1 or boot.
sim::Expected<PowerUp> parse_power_up(std::string_view text);

/// keep or stop; true: closing the tty stops its streams.
sim::Expected<bool> parse_on_close(std::string_view text);

sim::Expected<std::uint64_t> parse_seed(std::string_view text);

/// NAME:=VALUE, as the program xacro has it.
sim::Expected<std::pair<std::string, std::string>> parse_xacro_argument(std::string_view text);
/// visual or collision.
sim::Expected<sim::SdfGeometry> parse_geometry(std::string_view text);

/// true or false.
sim::Expected<bool> parse_switch(std::string_view text);

/// wall or poses.
sim::Expected<ClockKind> parse_clock(std::string_view text);

/// X,Y,YAW or X,Y,Z,ROLL,PITCH,YAW.
sim::Expected<sim::Pose> parse_pose(std::string_view text);

/// A warning where the angles of such a pose look like degrees.
std::optional<std::string> degrees_in_pose(std::string_view text);

/// ADDR:PORT, [IPv6]:PORT or localhost:PORT. The result's host is numeric.
sim::Expected<Address> parse_address(std::string_view text);

/// As parse_address(); nothing for `none`.
sim::Expected<std::optional<Address>> parse_listener(std::string_view text);

/// A link, auto, or nothing for `none`.
sim::Expected<std::optional<PtyConfig>> parse_pty(std::string_view text,
                                                  const std::filesystem::path& base);

/// A file that exists.
sim::Expected<std::filesystem::path> parse_file(std::string_view text,
                                                const std::filesystem::path& base);

/// A file that exists, or a folder.
sim::Expected<std::filesystem::path> parse_scene(std::string_view text,
                                                 const std::filesystem::path& base);

/// The path of a socket, short enough for the system.
sim::Expected<std::filesystem::path> parse_socket(std::string_view text,
                                                  const std::filesystem::path& base);

}  // namespace scipd::daemon
