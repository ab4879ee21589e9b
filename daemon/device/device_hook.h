// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Stands between a scanner's mirror and its sessions, so that scans can go wrong on purpose. Lives
// on the I/O thread.
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/session_hook.h"
#include "sim/sensor/scan.h"
#include "sim/sensor/sensor_spec.h"
#include "sim/time.h"
#include "sim/world/pose.h"

namespace scipd::daemon {

/// What a sensor knows wrongly of where it is.
struct PoseShift {
    std::optional<sim::Time> stopped_at;  ///< nothing later has come
    sim::Time late{};                     ///< all comes so much later
    sim::Pose jump;                       ///< W from W: all is displaced by this

    bool operator==(const PoseShift&) const = default;
};

class DeviceHook : public protocol::SessionHook {
  public:
    /// A revolution is complete. False: it passes as if there had been none.
    virtual bool serves(std::int64_t revolution) = 0;
    /// How much later than usual scans leave.
    [[nodiscard]] virtual sim::Time late() const = 0;
    /// May change what the sensor read.
    virtual void read(sim::Scan& scan, const sim::SensorSpec& optics) = 0;
    virtual void booted() = 0;
};

}  // namespace scipd::daemon
