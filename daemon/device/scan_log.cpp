// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/device/scan_log.h"

#include <algorithm>
#include <utility>

namespace scipd::daemon {

void ScanLog::add(SharedRecord record) {
    const sim::Scan& scan = *record->cast;
    // One that is cast again replaces what was said of it.
    while (!records_.empty() && last() >= scan.revolution)
        records_.pop_back();
    while (!records_.empty() &&
           (records_.size() >= capacity || scan.start - records_.front()->cast->start > span))
        records_.pop_front();
    records_.push_back(std::move(record));
}

SharedRecord ScanLog::latest() const {
    return records_.empty() ? nullptr : records_.back();
}

SharedRecord ScanLog::find(std::int64_t revolution) const {
    const auto found = std::ranges::find(
        records_, revolution, [](const SharedRecord& record) { return record->cast->revolution; });
    return found == records_.end() ? nullptr : *found;
}

}  // namespace scipd::daemon
