// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Measurements as JSON: what a sensor said, for /stream and GET /reading, and what was true when it
// measured, for GET /truth. Any thread; nothing shared.
#pragma once

#include <string>
#include <string_view>

#include "daemon/device/sensor_record.h"

namespace scipd::daemon {

/// "measured", "too_dark", ..
std::string_view cause_word(sim::Cause cause);

// The pose is that of the beam in the middle.

/// What a scanner said: {"sensor","scan","time_s","stamp_ms","pose","first_step","front_step",
/// "steps_per_turn","sent_mm","intensity"}
std::string reading_text(const std::string& sensor, const ScanRecord& record);

/// What a camera or a ranger said: {"sensor","scan","time_s","pose"}, and then of a camera
/// {"columns","rows","range_m":[..]}, of a ranger {"range_m":x}; null where it says nothing.
std::string reading_text(const std::string& sensor, const StaringRecord& record);

/// {"sensor","scan","time_s","stamp_ms","backend","backend_reason","poses":[{"time_s","xyz","q"}],
/// "steps","true_m","object","material","incidence_rad","sent_mm","intensity","accuracy","read_m",
/// "cause"}: one pose for each fan that was cast; the other lists have an element for each step,
/// null where nothing is hit or read. A scan with echoes adds {"echoes":[[{"range_m","power",
/// "object","material"}]]}, object and material null for what is in the air; a scanner that tells
/// several of them {"sent_echoes_mm":[[..]],"sent_echoes_intensity":[[..]]}.
std::string truth_text(const std::string& sensor, const ScanRecord& record);

/// What a camera or ranger measured, without what a wire has: {"sensor","scan","time_s","backend",
/// "backend_reason","poses","true_m","object","material","incidence_rad"} and what it says.
std::string truth_text(const std::string& sensor, const StaringRecord& record);

}  // namespace scipd::daemon
