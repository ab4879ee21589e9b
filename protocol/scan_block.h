// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a scan looks like behind the status line: inputs and outputs, time stamp and data, in each
// of the formats.
#pragma once

#include <cstdint>
#include <vector>

#include "protocol/command.h"
#include "protocol/device_profile.h"
#include "protocol/device_state.h"
#include "protocol/reply.h"
#include "protocol/scan_view.h"
#include "protocol/step_window.h"

namespace scipd::protocol {

/// What goes into the data block of a format with one echo: a distance for each group of `cluster`
/// steps, or what the window's contents are. The last group is shorter where the window does not
/// divide evenly: a recorded UTM-30LX sends 271 values for 1081 steps in fours. The value of a
/// group is its nearest distance; a code stands for a group that has no distance. The intensity
/// that may follow is that of the same step.
[[nodiscard]] std::vector<std::uint32_t> values_in(const ScanView& scan, const StepWindow& window,
                                                   DataFormat format, const DeviceProfile& profile);

void add_scan(Reply& reply, const ScanView& scan, const StepWindow& window, DataFormat format,
              const DeviceState& device, const DeviceProfile& profile);

}  // namespace scipd::protocol
