// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/poses/arrivals.h"

#include <algorithm>

namespace scipd::daemon {
namespace {

using Seconds = std::chrono::duration<double>;

std::int64_t number_of(Arrivals::Moment moment) {
    return std::chrono::floor<std::chrono::seconds>(moment.time_since_epoch()).count();
}

}  // namespace

void Arrivals::note(Moment now, std::optional<sim::Time> lateness) {
    ++messages_;
    if (!first_) first_ = now;
    last_ = now;
    const std::int64_t number = number_of(now);
    Second& second = seconds_[number % seconds_.size()];
    if (second.number != number) second = {.number = number};
    ++second.came;
    if (!lateness) return;
    const double late_ms = std::chrono::duration<double, std::milli>(*lateness).count();
    second.most_late_ms = second.stamped == 0 ? late_ms : std::max(second.most_late_ms, late_ms);
    second.late_ms += late_ms;
    ++second.stamped;
}

void Arrivals::tell(Moment now, SourceReport& report) const {
    report.messages = messages_;
    report.refused = refused_;
    if (!first_) return;
    report.age_s = Seconds(now - last_).count();
    Second sum;
    for (const Second& second : seconds_) {
        if (second.number <= number_of(now) - static_cast<std::int64_t>(seconds_.size())) continue;
        if (second.stamped > 0)
            sum.most_late_ms = sum.stamped == 0 ? second.most_late_ms
                                                : std::max(sum.most_late_ms, second.most_late_ms);
        sum.came += second.came;
        sum.stamped += second.stamped;
        sum.late_ms += second.late_ms;
    }
    // The present second has only begun; a source that has just begun has no more than that.
    const Moment begin(std::chrono::seconds(number_of(now) + 1 - std::ssize(seconds_)));
    const double lasted_s = Seconds(now - std::max(begin, *first_)).count();
    constexpr double shortest_s = 0.2;
    report.rate_hz = static_cast<double>(sum.came) / std::max(lasted_s, shortest_s);
    if (sum.stamped == 0) return;
    report.late_ms = sum.late_ms / static_cast<double>(sum.stamped);
    report.most_late_ms = sum.most_late_ms;
}

}  // namespace scipd::daemon
