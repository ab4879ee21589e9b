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

/// Where a vehicle says its state: uagv/v2/MANUFACTURER/SERIAL/state.
std::string vda5050_topic(std::string_view manufacturer, std::string_view serial);

/// The pose, with the vehicle's own time, and its velocity where it tells one. A vehicle is on the
/// ground: the height is 0. Refused where it does not know where it is.
sim::Expected<sim::PoseLine> parse_vda5050_state(std::string_view text);

}  // namespace scipd::daemon
