// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scanner's clock against ours, by asking it for its time again and again. One thread.
#pragma once

#include <optional>

#include "protocol/client/driver.h"
#include "tools/analysis/stamp_statistics.h"

namespace scipd::tools {

/// Asks about forty times, within half a second. None if the scanner does not answer. The laser
/// is off meanwhile, and the stream stands still.
[[nodiscard]] std::optional<ClockReading> read_clock(protocol::client::Driver& driver);

}  // namespace scipd::tools
