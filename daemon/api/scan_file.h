// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Scans of a scanner of this daemon as the bytes of a recording, made by what scipcat writes files
// with. Any thread; nothing shared.
#pragma once

#include <string>
#include <vector>

#include "daemon/device/sensor_record.h"
#include "protocol/device_profile.h"
#include "sim/expected.h"
#include "sim/recording/values/recorded_scan.h"
#include "sim/recording/values/scanner_identity.h"

namespace scipd::daemon {

[[nodiscard]] sim::ScannerIdentity identity_of(const protocol::DeviceProfile& profile);

/// What the scanner sends of it to who asks for everything. Its time is that of step 0.
[[nodiscard]] sim::RecordedScan recorded_scan(const ScanRecord& record,
                                              const sim::ScannerIdentity& identity);

/// `ending`: ".mcap", one of sim::recording_endings.
[[nodiscard]] sim::Expected<std::string> scan_file(const std::string& ending,
                                                   const sim::ScannerIdentity& identity,
                                                   const std::vector<sim::RecordedScan>& scans);

}  // namespace scipd::daemon
