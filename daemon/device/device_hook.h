// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Stands between a scanner's mirror and its sessions, so that scans can go wrong on purpose. Lives
// on its shard.
#pragma once

#include <cstdint>
#include <vector>

#include "daemon/device/sensor_record.h"
#include "protocol/session_hook.h"
#include "sim/sensor/scan.h"
#include "sim/sensor/sensor_spec.h"

namespace scipd::daemon {

class DeviceHook : public protocol::SessionHook {
  public:
    /// A revolution is complete, and nobody has been told yet. Clients may come and go in here.
    virtual void turn(std::int64_t revolution) = 0;
    /// Whether anybody gets the scan of a complete revolution.
    virtual bool serves(std::int64_t revolution) = 0;
    /// May change what the sensor read. Returns the changes.
    virtual std::vector<ReadingFault> read(sim::Scan& scan, const sim::SensorSpec& optics) = 0;
    virtual void booted() = 0;
};

}  // namespace scipd::daemon
