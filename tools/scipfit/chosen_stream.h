// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The scans of one scanner out of a recording that may hold several. One thread.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "sim/recording/values/recording.h"

namespace scipd::tools {

using TakeScan = std::function<void(const sim::RecordedScan&, const sim::RecordedStream&)>;

/// Calls `take` with each scan of `stream`, or where that is empty of the first stream that has
/// scans; several are told on standard error then. Shows on a terminal how far it is. Returns which
/// stream it was. `name`: of the file, for messages. Throws WrongInput where there are no scans, or
/// the recording is damaged.
std::size_t for_each_scan(sim::Recording& recording, const std::string& name,
                          const std::string& stream, const TakeScan& take);

}  // namespace scipd::tools
