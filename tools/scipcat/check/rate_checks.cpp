// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How often scans come, and how soon replies.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "tools/scipcat/check/check_table.h"

namespace scipd::tools::checks {
namespace {

using protocol::client::ScanMessage;
using std::chrono::milliseconds;

constexpr std::string_view in_urg_library = "urg_library";

/// How far the stamps of neighbouring scans are apart.
std::vector<double> stamp_periods(const std::vector<ScanMessage>& scans) {
    std::vector<double> periods;
    for (std::size_t i = 1; i < scans.size(); ++i)
        periods.push_back(since(scans[i - 1].stamp_ms, scans[i].stamp_ms));
    return periods;
}

std::vector<ScanMessage> some_scans(Subject& subject, const std::string& window, int count) {
    subject.rest();
    subject.stream("MD" + window + "01000");
    return subject.scans(count);
}

Finding as_often_as_said(Subject& subject) {
    constexpr double share = 0.01;
    const auto scans = some_scans(subject, subject.window(), 16);
    const double mean = since(scans.front().stamp_ms, scans.back().stamp_ms) /
                        static_cast<double>(scans.size() - 1);
    const double said = subject.facts().period_ms();
    const double rounding = 1.0 / static_cast<double>(scans.size() - 1);
    return require(std::abs(mean - said) <= share * said + rounding,
                   "stamps are " + tenths(mean) + " ms apart; SCAN says " + tenths(said));
}

Finding none_left_out(Subject& subject, const std::string& window) {
    constexpr double most = 1.5;
    for (const double period : stamp_periods(some_scans(subject, window, 11))) {
        if (period > most * subject.facts().period_ms())
            return fail("two stamps are " + tenths(period) + " ms apart");
        if (period < subject.facts().period_ms() / 2)
            return fail("two stamps are only " + tenths(period) + " ms apart");
    }
    return pass();
}

/// A scan that came late to this machine makes the next seem to come too soon; hence the tries.
Finding as_often_here(Subject& subject) {
    constexpr int tries = 4;
    constexpr int count = 12;
    constexpr double share = 0.15;
    const double said = subject.facts().period_ms();
    double mean = 0.0;
    for (int i = 0; i < tries; ++i) {
        subject.rest();
        subject.stream("MD" + subject.window() + "01000");
        (void)subject.scans(1);
        const auto begin = Clock::now();
        (void)subject.scans(count);
        mean = std::chrono::duration<double, std::milli>(Clock::now() - begin).count() / count;
        if (std::abs(mean - said) <= share * said) return pass();
    }
    return fail("scans come every " + tenths(mean) + " ms; SCAN says " + tenths(said));
}

/// The quickest of some tries: what is late may be this machine.
Finding within(Subject& subject, double limit_ms, const std::function<double()>& took_ms) {
    constexpr int tries = 4;
    double quickest = std::numeric_limits<double>::max();
    for (int i = 0; i < tries && quickest >= limit_ms; ++i) {
        subject.rest();
        quickest = std::min(quickest, took_ms());
    }
    return require(quickest < limit_ms, "it takes " + tenths(quickest) + " ms");
}

Finding prompt(Subject& subject, const std::string& request) {
    constexpr double limit_ms = 140.0;
    return within(subject, limit_ms, [&] { return subject.ask(request).took_ms(); });
}

Finding prompt_time(Subject& subject) {
    constexpr double limit_ms = 100.0;
    return within(subject, limit_ms, [&] {
        (void)subject.ask("TM0");
        return subject.ask("TM1").took_ms();
    });
}

Finding prompt_scan(Subject& subject) {
    constexpr double most_turns = 16.0;
    return within(subject, most_turns * subject.facts().period_ms(), [&] {
        subject.measure();
        const Answer answer = subject.ask("GD" + subject.all() + "01");
        (void)scan_of(answer);
        return answer.took_ms();
    });
}

Finding prompt_stream(Subject& subject) {
    constexpr double most_turns = 16.0;
    return within(subject, most_turns * subject.facts().period_ms(), [&] {
        subject.stream("MD" + subject.window() + "01000");
        const auto begin = Clock::now();
        (void)subject.scans(1);
        return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    });
}

// Both may come late to this machine, and then together; hence the tries.
Finding acknowledged_apart(Subject& subject) {
    constexpr double least_ms = 2.0;
    constexpr int tries = 4;
    for (int i = 0; i < tries; ++i) {
        subject.rest();
        const Answer answer = subject.ask("MD" + subject.window() + "01001");
        const Answer scan = subject.next_scan();
        if (std::chrono::duration<double, std::milli>(scan.came_at - answer.came_at).count() >=
            least_ms)
            return pass();
    }
    return fail("the acknowledgement comes with the first scan");
}

constexpr Check table_of_rates[] = {
    {"13.1", "stamps of scans are as far apart as SCAN says, to 1 %",
     "recorded URG-04LX, UTM-30LX; urg_stamped", as_often_as_said},
    {"13.2", "no turn is left out of a stream of one step", in_urg_library,
     [](Subject& subject) { return none_left_out(subject, subject.window()); }},
    {"13.3", "no turn is left out of a stream of all steps", in_urg_library,
     [](Subject& subject) { return none_left_out(subject, subject.all()); }},
    {"13.4", "scans come as often as SCAN says by this machine's clock, to 15 %", in_urg_library,
     as_often_here},
    {"13.5", "QT is answered within 140 ms", "urg_library's time for QT and PP",
     [](Subject& subject) { return prompt(subject, "QT"); }},
    {"13.6", "PP is answered within 140 ms", "urg_library's time for QT and PP",
     [](Subject& subject) { return prompt(subject, "PP"); }},
    {"13.7", "TM1 in adjust mode is answered within 100 ms", "Rock's driver", prompt_time},
    {"13.8", "GD brings all steps within 16 turns", "urg_library's time after PP", prompt_scan},
    {"13.9", "the first scan of a stream comes within 16 turns", "urg_library's time after PP",
     prompt_stream},
    {"13.10", "the acknowledgement of MD does not wait for the first scan",
     "recorded UTM-30LX; MRPT", acknowledged_apart},
};

}  // namespace

std::span<const Check> rate_checks() {
    return table_of_rates;
}

}  // namespace scipd::tools::checks
