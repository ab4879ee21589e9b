// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which value of a recorded scan stands for which step of a scanner. A value; any thread.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "sim/recording/values/recorded_scan.h"
#include "sim/sensor/sensor_spec.h"

namespace scipd::daemon {

/// For each step that the scanner measures, the value of the scan that looks there; nothing: none
/// does. By SCIP's steps where the recording has them, else by angles, else one by one where there
/// are as many values as steps. Empty: nobody can tell.
[[nodiscard]] std::vector<std::optional<std::size_t>> map_of_steps(const sim::RecordedScan& scan,
                                                                   const sim::SensorSpec& optics);

}  // namespace scipd::daemon
