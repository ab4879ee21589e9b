// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Logs of Player (its driver writelog, file version 0.2 or 0.3): a message a line. Read are those
// of the interface laser; each device is a stream. Ranges are in metres. Any thread; nothing
// shared.
#pragma once

#include <memory>

#include "sim/recording/file/input_file.h"
#include "sim/recording/values/recording.h"

namespace scipd::sim {

[[nodiscard]] Expected<std::unique_ptr<Recording>> open_player(InputFile file);

}  // namespace scipd::sim
