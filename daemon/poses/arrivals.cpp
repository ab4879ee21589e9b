// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/poses/arrivals.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <spdlog/spdlog.h>

namespace scipd::daemon {
namespace {

using Seconds = std::chrono::duration<double>;

std::int64_t number_of(Arrivals::Moment moment) {
    return std::chrono::floor<std::chrono::seconds>(moment.time_since_epoch()).count();
}

std::string with_number(const char* format, double number) {
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(), format, number);
    return text.data();
}

double milliseconds(std::chrono::nanoseconds time) {
    return std::chrono::duration<double, std::milli>(time).count();
}

/// Continues a sentence on poses with what to do; empty where they are good enough.
std::string too_seldom_or_late(double period_ms, double late_ms, const PoseNeeds& needs) {
    constexpr double margin_ms = 15.0;
    constexpr double longest_wait_ms = 900.0;
    const sim::PosePolicy& policy = needs.policy;
    const double age_ms = period_ms + late_ms - milliseconds(needs.wait);
    if (period_ms > milliseconds(policy.longest_gap))
        return ": the robot jumps from each to the next; send more than one a second";
    if (policy.after == sim::PosePolicy::After::extrapolate) {
        if (age_ms <= milliseconds(policy.stale_after)) return {};
        return with_number(": the robot stands before each comes; send more, or set stale_s: %.1f",
                           0.1 * std::ceil(0.01 * (age_ms + margin_ms)));
    }
    if (age_ms <= 0.5 * milliseconds(needs.sweep)) return {};
    std::string text = with_number(": scans use poses up to %.0f ms old; set ", age_ms);
    const double wait_ms = std::ceil(period_ms + late_ms + margin_ms);
    if (wait_ms <= longest_wait_ms) text += with_number("wait_ms: %.0f, or ", wait_ms);
    return text + "after: extrapolate";
}

}  // namespace

void Arrivals::note(Moment now, std::optional<sim::Time> lateness) {
    constexpr auto pause = std::chrono::seconds(10);
    ++messages_;
    if (!first_) looked_ = first_ = now;
    if (now - last_ > pause) {  // its rate is that of what follows
        looked_ = now;
        messages_then_ = messages_;
    }
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

void Arrivals::log(Moment now, const std::string& robot, const PoseNeeds& needs) {
    if (const auto said = news(now, needs))
        spdlog::log(said->warns ? spdlog::level::warn : spdlog::level::info, "poses of {} {}",
                    robot, said->text);
}

std::optional<Arrivals::News> Arrivals::news(Moment now, const PoseNeeds& needs) {
    constexpr auto first_look = std::chrono::seconds(2);
    constexpr auto later_looks = std::chrono::seconds(5);
    if (!looked_ || now - *looked_ < (told_ ? later_looks : first_look)) return std::nullopt;
    const double period_ms =
        milliseconds(now - *looked_) / static_cast<double>(messages_ - messages_then_);
    looked_ = now;
    messages_then_ = messages_;
    SourceReport report;
    tell(now, report);
    const double late_ms = std::max(0.0, report.most_late_ms.value_or(0.0));
    std::string why = too_seldom_or_late(period_ms, late_ms, needs);
    const bool is_news = !told_ || (!why.empty() && !warned_);
    told_ = true;
    warned_ = !why.empty();
    if (!is_news) return std::nullopt;
    std::string text = with_number("come %.3g times a second", 1000.0 / period_ms);
    text +=
        report.most_late_ms ? with_number(", up to %.0f ms late", late_ms) : ", without timestamps";
    return News{warned_, text + why};
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
