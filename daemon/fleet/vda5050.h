// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What an automated guided vehicle says of itself by VDA 5050 (2.0): its `state`, of which only the
// place matters here. Values; any thread.
#pragma once

#include <string>
#include <string_view>

#include "sim/expected.h"
#include "sim/loaders/poses/pose_line.h"

namespace scipd::daemon {

/// Where a vehicle says its state: uagv/v2/MANUFACTURER/SERIAL/state. The vehicle is
/// MANUFACTURER/SERIAL, or MANUFACTURER of one whose serial is the name of the robot.
std::string vda5050_topic(const std::string& vehicle, const std::string& robot);

/// The pose, with the vehicle's own time, and its velocity where it tells one. A vehicle is on the
/// ground: the height is 0. Refused where it does not know where it is.
sim::Expected<sim::PoseLine> parse_vda5050_state(std::string_view text);

}  // namespace scipd::daemon
