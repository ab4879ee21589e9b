// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Scans that are missing, late or old, and windows that something covers.
#include "daemon/faults/fault_kind.h"

namespace scipd::daemon {

std::span<const FaultKind> scan_kinds() {
    return {};
}

}  // namespace scipd::daemon
