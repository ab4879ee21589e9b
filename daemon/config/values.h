// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One setting each, from the text that a user wrote, in a file or on the command line: the same
// rules and the same sentences for both. Every function throws std::invalid_argument, saying what
// to do. Relative paths are taken from `base`. Any thread; nothing shared.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "daemon/config/config.h"

namespace scipd::daemon {

/// Of a robot or a sensor: letters, digits, _ - .
std::string parse_name(std::string_view text);

/// One that the registry of models knows.
Model parse_model(std::string_view text);

/// auto, or one that this build has.
std::string parse_backend(std::string_view text);

/// nearest, interpolate or exact: what a depth buffer says of beams between its pixels.
sim::BetweenPixels parse_between_pixels(std::string_view text);

sim::Accuracy parse_accuracy(std::string_view text);
Timing parse_timing(std::string_view text);

/// A number of poses per sweep; nothing stands for `beam`.
std::optional<int> parse_motion(std::string_view text);

/// scip2.0, scip1.1 or boot.
PowerUp parse_power_up(std::string_view text);

/// Whether a tty's close stops its streams: keep or stop.
bool parse_on_close(std::string_view text);

std::uint64_t parse_seed(std::string_view text);

/// visual or collision.
sim::SdfGeometry parse_geometry(std::string_view text);

/// true or false.
bool parse_switch(std::string_view text);

/// wall or poses.
ClockKind parse_clock(std::string_view text);

/// X,Y,YAW or X,Y,Z,ROLL,PITCH,YAW.
sim::Pose parse_pose(std::string_view text);

/// ADDR:PORT, [IPv6]:PORT or localhost:PORT. The result's host is numeric.
Address parse_address(std::string_view text);

/// The same, or nothing for `none`.
std::optional<Address> parse_listener(std::string_view text);

/// A link, auto, or nothing for `none`.
std::optional<PtyConfig> parse_pty(std::string_view text, const std::filesystem::path& base);

/// udp:ADDR:PORT, - or a file that exists.
PoseSource parse_pose_source(std::string_view text, const std::filesystem::path& base);

/// A file that exists.
std::filesystem::path parse_file(std::string_view text, const std::filesystem::path& base);

/// A file that exists, or a folder.
std::filesystem::path parse_scene(std::string_view text, const std::filesystem::path& base);

/// Where a socket is to be: short enough for the system.
std::filesystem::path parse_socket(std::string_view text, const std::filesystem::path& base);

}  // namespace scipd::daemon
