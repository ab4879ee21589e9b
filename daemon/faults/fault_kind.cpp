// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/faults/fault_kind.h"

namespace scipd::daemon {

std::vector<const FaultKind*> fault_kinds() {
    std::vector<const FaultKind*> kinds;
    for (const auto layer :
         {byte_kinds(), line_kinds(), cut_kinds(), message_kinds(), device_kinds(), clock_kinds(),
          repeat_kinds(), scan_kinds(), window_kinds(), pose_kinds()}) {
        for (const FaultKind& kind : layer)
            kinds.push_back(&kind);
    }
    return kinds;
}

const FaultKind* find_fault_kind(std::string_view name) {
    for (const FaultKind* const kind : fault_kinds()) {
        if (kind->name == name) return kind;
    }
    return nullptr;
}

}  // namespace scipd::daemon
