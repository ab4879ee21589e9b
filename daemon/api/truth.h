// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What was true when a scan was measured, beside what was sent, as the control API tells it.
#pragma once

#include <string>

#include "daemon/device/sensor_record.h"

namespace scipd::daemon {

/// {"sensor","scan","time_s","stamp_ms","backend","backend_reason","poses":[{"time_s","xyz","q"}],
/// "steps","true_m","object","material","incidence_rad","sent_mm","intensity"}: a pose for each fan
/// that was cast, the others an element a step; null where nothing is hit.
std::string truth_text(const std::string& sensor, const ScanRecord& record);

/// The same of a camera or ranger, without what a wire has: {"sensor","scan","time_s","backend",
/// "backend_reason","poses","true_m","object","material","incidence_rad"} and what it says.
std::string truth_text(const std::string& sensor, const StaringRecord& record);

}  // namespace scipd::daemon
