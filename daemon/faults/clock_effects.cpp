// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The clock of a scanner jumps, drifts, wraps or stands still.
#include "daemon/faults/fault_kind.h"

namespace scipd::daemon {

std::span<const FaultKind> clock_kinds() {
    return {};
}

}  // namespace scipd::daemon
