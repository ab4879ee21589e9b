// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a scan looks like behind the status line: inputs and outputs, time stamp and data, in each
// of the formats.
#pragma once

#include "protocol/command_table.h"
#include "protocol/device_profile.h"
#include "protocol/device_state.h"
#include "protocol/reply.h"
#include "protocol/scan_view.h"
#include "protocol/step_window.h"

namespace scipd::protocol {

void add_scan(Reply& reply, const ScanView& scan, const StepWindow& window, DataFormat format,
              const DeviceState& device, const DeviceProfile& profile);

}  // namespace scipd::protocol
