// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/bare_timer.h"

#include <algorithm>

namespace scipd::tools {

BareTimer::BareTimer(Clock::duration period)
    : thread_([this, period](const std::stop_token& stop) { wake_until_stopped(stop, period); }) {}

void BareTimer::wake_until_stopped(const std::stop_token& stop, Clock::duration period) {
    for (Clock::time_point due = Clock::now() + period; !stop.stop_requested(); due += period) {
        std::this_thread::sleep_until(due);
        wakings_.push_back({due, Clock::now()});
    }
}

std::vector<double> BareTimer::late_ms_since(Clock::time_point begin) {
    thread_.request_stop();
    thread_.join();
    std::vector<double> late_ms;
    for (const auto& [due, woke] : wakings_) {
        if (due >= begin)
            late_ms.push_back(std::chrono::duration<double, std::milli>(woke - due).count());
    }
    std::ranges::sort(late_ms);
    return late_ms;
}

}  // namespace scipd::tools
