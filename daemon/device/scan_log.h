// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The latest scans of a device, as they were cast and as they were sent.
#pragma once

#include <cstdint>
#include <memory>

#include "daemon/device/bridge.h"
#include "daemon/device/measurement.h"
#include "daemon/device/record_log.h"

namespace scipd::daemon {

struct ScanRecord : Measurement {
    WireScan sent;
    std::uint32_t stamp_ms = 0;  ///< what the wire says of its time
    int front_step = 0;
    int steps_per_turn = 0;
};

using SharedRecord = std::shared_ptr<const ScanRecord>;

class ScanLog : public RecordLog<ScanRecord> {};

}  // namespace scipd::daemon
