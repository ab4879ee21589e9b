// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/faults/fault_log.h"

#include <utility>

namespace scipd::daemon {

void FaultLog::add(FaultLogEntry entry) {
    entry.number = ++last_;
    if (watcher_) watcher_(entry);
    if (entries_.size() == capacity) entries_.pop_front();
    entries_.push_back(std::move(entry));
}

}  // namespace scipd::daemon
