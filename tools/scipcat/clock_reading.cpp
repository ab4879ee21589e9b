// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/clock_reading.h"

#include <chrono>
#include <cmath>
#include <vector>

#include "protocol/client/error.h"
#include "tools/statistics/beam_statistics.h"

namespace scipd::tools {
namespace {

using Clock = std::chrono::system_clock;

/// One answer: the scanner's time is taken to be of the middle between question and answer.
struct Answer {
    double device_s;
    double host_s;
    double took_s;
};

double seconds(Clock::time_point time) {
    return std::chrono::duration<double>(time.time_since_epoch()).count();
}

std::vector<Answer> ask_for_time(protocol::client::Driver& driver) {
    constexpr std::size_t most = 40;
    const auto end = Clock::now() + std::chrono::milliseconds(500);
    std::vector<Answer> answers;
    driver.enter_adjust();
    while (answers.size() < most && Clock::now() < end) {
        const double asked_s = seconds(Clock::now());
        const double device_s = driver.time_ms() / 1e3;
        const double answered_s = seconds(Clock::now());
        answers.push_back({device_s, (asked_s + answered_s) / 2, answered_s - asked_s});
    }
    driver.leave_adjust();
    return answers;
}

}  // namespace

std::optional<ClockReading> read_clock(protocol::client::Driver& driver) {
    std::vector<Answer> answers;
    try {
        answers = ask_for_time(driver);
    } catch (const protocol::client::Error&) {
        return std::nullopt;
    }
    std::vector<double> times_s;
    for (const Answer& answer : answers)
        times_s.push_back(answer.took_s);
    // Whoever waited longer than usual knows less.
    const double usual_s = median_of(times_s);
    std::erase_if(answers, [&](const Answer& answer) { return answer.took_s > 1.5 * usual_s; });
    const auto count = static_cast<double>(answers.size());
    ClockReading reading;
    for (const Answer& answer : answers) {
        reading.device_s += answer.device_s / count;
        reading.host_s += answer.host_s / count;
    }
    double squares = 0;
    for (const Answer& answer : answers)
        squares += std::pow(answer.device_s - reading.device_s - answer.host_s + reading.host_s, 2);
    reading.deviation_s = std::sqrt(squares / (count - 1) / count);
    // The clock had ticked half a millisecond ago.
    reading.device_s += 0.5e-3;
    return answers.size() < 4 ? std::nullopt : std::optional(reading);
}

ClockRate rate_between(const ClockReading& before, const ClockReading& after) {
    constexpr double wrap_s = (1U << 24) / 1e3;
    // Scanners answer on a grid of their own, which the scatter of the answers does not show.
    constexpr double unseen_s = 5e-5;
    const double host_s = after.host_s - before.host_s;
    double device_s = after.device_s - before.device_s;
    device_s += wrap_s * std::round((host_s - device_s) / wrap_s);
    return {1e6 * (device_s / host_s - 1),
            1e6 * std::hypot(4 * before.deviation_s, 4 * after.deviation_s, unseen_s) / host_s};
}

}  // namespace scipd::tools
