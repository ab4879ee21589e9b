// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scanner that boots, sleeps, is in trouble, or whose motor is not at its speed.
#include "daemon/faults/fault_kind.h"

namespace scipd::daemon {

std::span<const FaultKind> device_kinds() {
    return {};
}

}  // namespace scipd::daemon
