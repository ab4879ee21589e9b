// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What sensors hand out of their latest measurements: one, or all that they have kept. Values; any
// thread. Whoever looks into one includes sensor_record.h.
#pragma once

#include <memory>
#include <variant>

#include "daemon/device/record_log.h"

namespace scipd::daemon {

struct ScanRecord;
struct StaringRecord;

using SharedRecord = std::shared_ptr<const ScanRecord>;
using SharedStaringRecord = std::shared_ptr<const StaringRecord>;
using ScanLog = RecordLog<ScanRecord>;
using StaringLog = RecordLog<StaringRecord>;

/// What a scanner, or a camera or ranger, measured.
using SensorRecord = std::variant<SharedRecord, SharedStaringRecord>;
using SensorLog = std::variant<ScanLog, StaringLog>;

}  // namespace scipd::daemon
