// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/faults/fault_log.h"

#include <utility>

namespace scipd::daemon {

namespace {

std::size_t places_of(const FaultLogEntry& entry) {
    return entry.bytes.size() + entry.steps.size();
}

}  // namespace

void FaultLog::add(FaultLogEntry entry) {
    entry.number = ++last_;
    if (watcher_) watcher_(entry);
    places_ += places_of(entry);
    entries_.push_back(std::move(entry));
    while (entries_.size() > capacity || places_ > most_places) {
        places_ -= places_of(entries_.front());
        entries_.pop_front();
    }
}

}  // namespace scipd::daemon
