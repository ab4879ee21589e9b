// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Logs of CARMEN: a message a line. Read are FLASER and RLASER of old logs, RAWLASERn and
// ROBOTLASERn of newer ones; each laser is a stream. Ranges are in metres. Any thread; nothing
// shared.
#pragma once

#include <memory>
#include <string_view>

#include "sim/recording/file/input_file.h"
#include "sim/recording/values/recording.h"

namespace scipd::sim {

/// Whether a line is one of such a log, a comment or a message.
[[nodiscard]] bool is_carmen_line(std::string_view line);

[[nodiscard]] Expected<std::unique_ptr<Recording>> open_carmen(InputFile file);

}  // namespace scipd::sim
