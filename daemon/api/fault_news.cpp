// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/fault_news.h"

#include <cstddef>
#include <utility>

namespace scipd::daemon {
namespace {

/// In one message: nobody reads more between two looks. Their numbers tell what is left out.
constexpr std::size_t most_events = 64;

}  // namespace

bool FaultNews::add(const std::string& event) {
    events_.push_back(event);
    if (events_.size() > most_events) events_.pop_front();
    return !told_ && look();
}

bool FaultNews::look() {
    told_ = !events_.empty();
    if (!told_) return false;
    std::string message;
    for (const std::string& event : std::exchange(events_, {}))
        message += (message.empty() ? R"({"faults":[)" : ",") + event;
    messages_.add(source_, message + "]}");
    return true;
}

}  // namespace scipd::daemon
