// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/faults/fault_kind.h"

namespace scipd::daemon {

std::vector<const FaultKind*> wire_kinds() {
    std::vector<const FaultKind*> kinds;
    for (const auto layer :
         {byte_kinds(), line_kinds(), cut_kinds(), message_kinds(), repeat_kinds()}) {
        for (const FaultKind& kind : layer)
            kinds.push_back(&kind);
    }
    return kinds;
}

}  // namespace scipd::daemon
