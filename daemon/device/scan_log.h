// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The latest scans of a device, as they were cast and as they were sent.
#pragma once

#include <cstdint>
#include <memory>

#include "daemon/control/sensor_backends.h"
#include "daemon/device/bridge.h"
#include "daemon/device/record_log.h"
#include "sim/sensor/scan.h"
#include "sim/world/scene.h"

namespace scipd::daemon {

struct ScanRecord {
    sim::SharedScan cast;
    WireScan sent;
    std::uint32_t stamp_ms = 0;  ///< what the wire says of its time
    sim::SharedScene scene;      ///< that it was cast into: what its ids mean
    SharedChoice backend;        ///< what cast it
    int front_step = 0;
    int steps_per_turn = 0;
    sim::Time origin{};  ///< what people call world time 0 (Clock)

    /// A world time as people call it.
    [[nodiscard]] sim::Time told(sim::Time time) const { return origin + time; }
};

using SharedRecord = std::shared_ptr<const ScanRecord>;

class ScanLog : public RecordLog<ScanRecord> {};

}  // namespace scipd::daemon
