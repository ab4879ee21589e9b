// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/read_clock.h"

#include <chrono>
#include <vector>

#include "protocol/client/error.h"

namespace scipd::tools {
namespace {

using Clock = std::chrono::system_clock;

double seconds(Clock::time_point time) {
    return std::chrono::duration<double>(time.time_since_epoch()).count();
}

std::vector<ClockAnswer> ask_for_time(protocol::client::Driver& driver) {
    constexpr std::size_t most = 40;
    const auto end = Clock::now() + std::chrono::milliseconds(500);
    std::vector<ClockAnswer> answers;
    driver.enter_adjust();
    while (answers.size() < most && Clock::now() < end) {
        const double asked_s = seconds(Clock::now());
        const double device_s = driver.time_ms() / 1e3;
        answers.push_back({device_s, asked_s, seconds(Clock::now())});
    }
    driver.leave_adjust();
    return answers;
}

}  // namespace

std::optional<ClockReading> read_clock(protocol::client::Driver& driver) {
    try {
        return clock_reading(ask_for_time(driver));
    } catch (const protocol::client::Error&) {
        return std::nullopt;
    }
}

}  // namespace scipd::tools
