// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// NumPy's .npy: an array of one scan, of scans x steps, or of scans x steps x (range, intensity).
// It says neither where the steps look nor when a scan was made. Integers are millimetres; so are
// floating-point numbers where one of the first scan is above 1000; others are metres. Any thread;
// nothing shared.
#pragma once

#include <memory>

#include "sim/recording/file/recording_file.h"
#include "sim/recording/values/recording.h"

namespace scipd::sim {

[[nodiscard]] Expected<std::unique_ptr<Recording>> open_npy(InputFile file);

}  // namespace scipd::sim
