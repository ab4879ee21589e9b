// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Bytes that change, are lost or come twice on their way to the client.
#include "daemon/faults/fault_kind.h"

namespace scipd::daemon {

std::span<const FaultKind> byte_kinds() {
    return {};
}

}  // namespace scipd::daemon
