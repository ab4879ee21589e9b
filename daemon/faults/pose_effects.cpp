// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A sensor that knows wrongly where it is.
#include "daemon/faults/fault_kind.h"

namespace scipd::daemon {

std::span<const FaultKind> pose_kinds() {
    return {};
}

}  // namespace scipd::daemon
