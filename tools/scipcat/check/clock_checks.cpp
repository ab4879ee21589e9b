// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The scanner's clock: time stamps, TM1 and II, and the wrap after 24 bits.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <thread>

#include "protocol/char_code.h"
#include "tools/scipcat/check/check_table.h"

namespace scipd::tools::checks {
namespace {

using std::chrono::milliseconds;

constexpr std::string_view spec_clock = "SCIP 2.0 (C-42-03320B) p. 12, 15";
constexpr std::uint32_t wrap_ms = 1U << 24U;
/// What the scanner's own pace may add between a time and its reply.
constexpr int slack_ms = 110;

double ms_between(Clock::time_point earlier, Clock::time_point later) {
    return std::chrono::duration<double, std::milli>(later - earlier).count();
}

/// The only line of a reply as a number.
std::uint64_t number_in(const Answer& answer) {
    const auto& lines = answer.message.lines;
    const auto time = lines.size() == 1 ? protocol::decode(lines.front()) : std::nullopt;
    return time.value_or(std::numeric_limits<std::uint64_t>::max());
}

Finding stamp_of_four(Subject& subject) {
    const auto lines = subject.scan(subject.window()).lines();
    return require(lines.size() == 4 && lines[2].size() == 5 &&
                       protocol::decode(lines[2].substr(0, 4)).has_value(),
                   "the line behind the status has not four characters of SCIP and a sum");
}

Finding reply_of_fifteen(Subject& subject) {
    subject.adjust();
    const Answer answer = subject.ask("TM1");
    constexpr std::size_t whole = 15;
    return require(answer.raw.size() == whole && number_in(answer) < wrap_ms,
                   "the reply to TM1 has " + std::to_string(answer.raw.size()) + " bytes");
}

Finding goes_forward(Subject& subject) {
    subject.adjust();
    auto last = static_cast<std::uint32_t>(number_in(subject.ask("TM1")));
    for (int i = 0; i < 10; ++i) {
        const auto now = static_cast<std::uint32_t>(number_in(subject.ask("TM1")));
        if (since(last, now) < 0) return fail("TM1 goes back in time");
        last = now;
    }
    return pass();
}

Finding as_fast_as_ours(Subject& subject) {
    constexpr double share = 0.02;
    subject.adjust();
    const Answer first = subject.ask("TM1");
    std::this_thread::sleep_for(milliseconds(800));
    const Answer second = subject.ask("TM1");
    const double theirs = since(static_cast<std::uint32_t>(number_in(first)),
                                static_cast<std::uint32_t>(number_in(second)));
    const double least = ms_between(first.came_at, second.asked_at);
    const double most = ms_between(first.asked_at, second.came_at);
    return require(theirs >= least * (1 - share) - 6 && theirs <= most * (1 + share) + 6,
                   "its clock counts " + tenths(theirs) + " ms in " + tenths(most) + " ms");
}

Finding stamps_on_clock(Subject& subject) {
    const std::uint32_t before = subject.clock_ms();
    subject.stream("MD" + subject.window() + "01002");
    const auto scans = subject.scans(2);
    const std::uint32_t after = subject.clock_ms();
    for (const auto& scan : scans) {
        if (since(before, scan.stamp_ms) < -slack_ms || since(scan.stamp_ms, after) < 0)
            return fail("TM1 says " + std::to_string(before) + " before and " +
                        std::to_string(after) + " after a scan of " +
                        std::to_string(scan.stamp_ms) + " ms");
    }
    return pass();
}

Finding state_on_clock(Subject& subject) {
    const std::uint32_t before = subject.clock_ms();
    Facts facts;
    take_texts(facts, subject.ask("II").raw);
    const std::uint32_t after = subject.clock_ms();
    const std::string text = facts.text("TIME");
    const auto time = text.size() == 6
                          ? static_cast<std::uint32_t>(std::strtoul(text.c_str(), nullptr, 16))
                          : static_cast<std::uint32_t>(protocol::decode(text).value_or(wrap_ms));
    return require(time < wrap_ms && since(before, time) >= 0 && since(time, after) >= 0,
                   "TM1 says " + std::to_string(before) + " before and " + std::to_string(after) +
                       " after II with TIME:" + text);
}

// The answer to TM1 that came soonest tells best when the scanner read its clock.
Answer soonest_time(Subject& subject) {
    constexpr int count = 5;
    Answer soonest = subject.ask("TM1");
    for (int i = 1; i < count; ++i) {
        Answer next = subject.ask("TM1");
        if (next.came_at - next.asked_at < soonest.came_at - soonest.asked_at)
            soonest = std::move(next);
    }
    return soonest;
}

// The least age of some scans: this machine may be late, but never early.
Finding stamped_at_step_0(Subject& subject) {
    constexpr int count = 8;
    constexpr double most_turns = 4.0;
    subject.adjust();
    const Answer time = soonest_time(subject);
    const auto clock = static_cast<std::uint32_t>(number_in(time));
    subject.rest();
    char last[32];
    std::snprintf(last, sizeof last, "MD%04d%04d01000", subject.facts().amax, subject.facts().amax);
    subject.stream(last);
    double age = std::numeric_limits<double>::max();
    for (int i = 0; i < count; ++i) {
        const Answer answer = subject.next_scan();
        const int begun = since(clock, scan_of(answer).stamp_ms);
        age = std::min(age, ms_between(time.asked_at, answer.came_at) - begun);
    }
    const double sweep =
        subject.facts().period_ms() * subject.facts().amax / std::max(subject.facts().ares, 1);
    return require(age >= 0.9 * sweep - 6 && age <= most_turns * subject.facts().period_ms() + 20,
                   "a scan comes " + tenths(age) + " ms after its stamp; from step 0 to " +
                       "its last step the mirror takes " + tenths(sweep) + " ms");
}

Finding wraps(Subject& subject) {
    constexpr std::uint32_t soon = 6000;
    const std::uint32_t clock = subject.clock_ms();
    if (clock < wrap_ms - soon) {
        return not_applicable("its clock wraps in " + std::to_string((wrap_ms - clock) / 1000) +
                              " s");
    }
    subject.stream("MD" + subject.window() + "01000");
    const auto turns = static_cast<int>((wrap_ms - clock) / subject.facts().period_ms()) + 20;
    auto last = subject.scans(1).front().stamp_ms;
    for (int i = 0; i < turns; ++i) {
        const std::uint32_t stamp = subject.scans(1).front().stamp_ms;
        const double period = since(last, stamp) / subject.facts().period_ms();
        if (stamp >= wrap_ms || period < 0.5 || period > 5.0)
            return fail("a stamp of " + std::to_string(stamp) + " follows " + std::to_string(last));
        last = stamp;
    }
    return require(last < soon, "the clock does not begin again at 0");
}

Finding named_times(Subject& subject) {
    subject.adjust();
    for (const char* const request : {"TM1;0000002a", "TM1;0000002b"}) {
        const Answer answer = subject.ask(request);
        if (number_in(answer) >= wrap_ms) return fail(std::string(request) + " brings no time");
    }
    return pass();
}

Finding microseconds(Subject& subject) {
    if (!subject.facts().knows("%TM")) return not_applicable("it does not know %TM1");
    constexpr std::size_t width = 11;
    const std::uint32_t before = subject.clock_ms();
    const Answer answer = subject.ask("%TM1");
    const std::uint32_t after = subject.clock_ms();
    const auto& lines = answer.message.lines;
    if (lines.size() != 1 || lines.front().size() != width)
        return fail("%TM1 does not bring eleven characters");
    const auto ms = static_cast<std::uint32_t>(number_in(answer) / 1000 % wrap_ms);
    return require(since(before, ms) >= 0 && since(ms, after) >= 0,
                   "%TM1 tells another time than TM1");
}

Finding microsecond_stamps(Subject& subject, const std::string& command) {
    if (!subject.facts().knows(command)) return not_applicable("it does not know " + command);
    return subject.expect_scans(command + subject.window() + "010", 2);
}

Finding reset_to_zero(Subject& subject) {
    if (subject.on_serial_line()) return not_applicable("RS would change the rate of its line");
    std::this_thread::sleep_for(milliseconds(400));
    subject.rest();
    const auto asked_at = Clock::now();
    if (auto fine = subject.expect("RS", "00"); !fine.passed()) return fine;
    const std::uint32_t clock = subject.clock_ms();
    const double most = ms_between(asked_at, Clock::now()) + 10;
    return require(clock <= most, "after RS its clock says " + std::to_string(clock) + " ms");
}

constexpr Check table_of_clocks[] = {
    {"8.1", "the time stamp of a scan has four characters", spec_clock, stamp_of_four},
    {"8.2", "the reply to TM1 has 15 bytes", "recorded UXM-30LX-E; hokuyoaist", reply_of_fifteen},
    {"8.3", "TM1 never goes back", spec_clock, goes_forward},
    {"8.4", "its clock runs as fast as this one, to 2 %", spec_clock, as_fast_as_ours},
    {"8.5", "time stamps and TM1 are of one clock", spec_clock, stamps_on_clock},
    {"8.6", "TIME of II and TM1 are of one clock", "recorded URG-04LX", state_on_clock},
    {"8.7", "a time stamp is that of step 0, and the scan comes soon after its last step",
     "SCIP 2.0 (C-42-03320B) p. 12; recorded URG-04LX and UTM-30LX", stamped_at_step_0},
    {"8.8", "time stamps wrap after 24 bits", spec_clock, wraps},
    {"8.9", "a string comes back with TM1", "urg_stamped", named_times},
    {"8.10", "%TM1 brings microseconds in eleven characters", "urg_stamped", microseconds},
    {"8.11", "%MD has stamps of eleven characters", "urg_stamped",
     [](Subject& subject) { return microsecond_stamps(subject, "%MD"); }},
    {"8.12", "%ME has stamps of eleven characters", "urg_stamped",
     [](Subject& subject) { return microsecond_stamps(subject, "%ME"); }},
    {"8.13", "RS sets the clock to 0", "SCIP 2.0 (C-42-03320B) p. 14", reset_to_zero},
};

}  // namespace

std::span<const Check> clock_checks() {
    return table_of_clocks;
}

}  // namespace scipd::tools::checks
