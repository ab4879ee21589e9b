// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a camera or a ranger says, as the control API and /stream tell it.
#pragma once

#include <string>

#include "daemon/api/object_text.h"
#include "daemon/device/sensor_record.h"

namespace scipd::daemon {

/// {"sensor","scan","time_s","pose"}, and then of a camera {"columns","rows","range_m":[..]}, of a
/// ranger {"range_m":x}: null where that is nothing. The pose is that of the beam in the middle.
std::string reading_text(const std::string& sensor, const StaringRecord& record);

/// Of that, what depends on the kind.
void add_said(ObjectText& text, const StaringRecord& record);

}  // namespace scipd::daemon
