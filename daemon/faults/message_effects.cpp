// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Messages of SCIP that are wrong, although each byte arrives as it was sent.
#include "daemon/faults/fault_kind.h"

namespace scipd::daemon {

std::span<const FaultKind> message_kinds() {
    return {};
}

}  // namespace scipd::daemon
