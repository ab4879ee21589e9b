// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/device/scan_watch.h"

#include <utility>

namespace scipd::daemon {

std::vector<std::string> ScanWatch::stuck(const std::vector<Look>& loops, Time now) {
    const auto before = std::exchange(overdue_, {});
    std::vector<std::string> stuck;
    for (const Look& loop : loops) {
        if (!loop.overdue) continue;
        const auto known = before.find(loop.sensor);
        const bool same_turn = known != before.end() && known->second.turn == loop.turn;
        const Time since = same_turn ? known->second.since : now;
        overdue_[loop.sensor] = {loop.turn, since};
        if (now - since >= patience_) stuck.push_back(loop.sensor);
    }
    return stuck;
}

}  // namespace scipd::daemon
