// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/device_profile.h"

namespace scipd::protocol {

bool DeviceProfile::has(Feature feature) const {
    switch (feature) {
        case Feature::common:
            return true;
        case Feature::multi_echo:
            return multi_echo;
        case Feature::microseconds:
            return microseconds;
        case Feature::io_lines:
            return io_lines;
    }
    return false;
}

Uptime DeviceProfile::nominal_scan_period() const {
    return scan_rpm > 0 ? Uptime(std::chrono::minutes(1)) / scan_rpm : scan_period;
}

}  // namespace scipd::protocol
