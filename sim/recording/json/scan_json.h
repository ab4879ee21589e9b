// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scan as members of a JSON object, the same in JSON lines and in the messages of an MCAP file.
// Any thread; nothing shared.
#pragma once

#include <nlohmann/json.hpp>

#include "sim/expected.h"
#include "sim/recording/values/recorded_scan.h"

namespace scipd::sim {

/// Adds stamp_ms or stamp_us, first_step, cluster, first_angle_rad, angle_increment_rad, as far as
/// they are known, then distances_mm (the first echo of each step), intensities where there are
/// any, and echoes: [[mm, ...], ...], or [mm, intensity] in the place of each mm. The scan is in
/// millimetres.
void add_scan(nlohmann::ordered_json& object, const RecordedScan& scan);

/// The scan of such an object. One without distances_mm must have `ranges`, in metres, as
/// foxglove.LaserScan has them; its angles are start_angle and end_angle. The fault names the
/// member.
[[nodiscard]] Expected<RecordedScan> scan_in(const nlohmann::json& object);

/// Since 1970, of seconds as a JSON number has them: to a microsecond.
[[nodiscard]] HostTime host_time_of(double seconds);

}  // namespace scipd::sim
