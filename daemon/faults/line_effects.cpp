// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A line that is late, stalls, joins or splits what is sent, is cut or hangs up.
#include "daemon/faults/fault_kind.h"

namespace scipd::daemon {

std::span<const FaultKind> line_kinds() {
    return {};
}

}  // namespace scipd::daemon
