// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where metres meet steps: the one file that knows both the words of sim/ and those of the wire.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "protocol/device_profile.h"
#include "protocol/scan_view.h"
#include "sim/sensor/scan.h"
#include "sim/sensor/sensor_spec.h"

namespace scipd::daemon {

/// A scan in the words of the wire.
struct WireScan {
    protocol::Turn turn;
    int first_step = 0;
    std::vector<std::uint32_t> distance;
    std::vector<std::uint32_t> intensity;
    std::vector<protocol::StepEchoes> echoes;  ///< of scanners that tell several; else empty

    /// Valid as long as this.
    [[nodiscard]] protocol::ScanView view() const;
};

/// `turn`: the scan's, on the device's own clock.
[[nodiscard]] WireScan to_wire(const sim::Scan& scan, const protocol::Turn& turn,
                               const sim::SensorSpec& optics,
                               const protocol::DeviceProfile& profile);

/// Puts into `wire` what a fault has made of readings, where it has changed them.
void put_changed(std::span<const sim::Reading> before, std::span<const sim::Reading> now,
                 const protocol::DeviceProfile& profile, WireScan& wire);

/// Millimetres, or the model's code where there is no distance that it could report.
[[nodiscard]] std::uint32_t distance_on_wire(float range_m, const protocol::DeviceProfile& profile);

}  // namespace scipd::daemon
