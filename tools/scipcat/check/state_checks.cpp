// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Laser, adjust mode, and what is refused in which state.
#include <string>

#include "tools/scipcat/check/check_table.h"

namespace scipd::tools::checks {
namespace {

constexpr std::string_view spec_bm = "SCIP 2.0 (C-42-03320B) p. 14; recorded URG-04LX";
constexpr std::string_view spec_tm = "SCIP 2.0 (C-42-03320B) p. 15; recorded UXM-30LX-E";
constexpr std::string_view only_tm = "SCIP 2.0 (C-42-03320B) p. 15; urg_library, UrgBenri";
constexpr std::string_view on_ethernet = "urg_stamped and its simulator, hokuyolx";

Finding in_adjust(Subject& subject, const std::string& request, std::string_view status) {
    subject.adjust();
    return subject.expect(request, status);
}

/// What %ST says in the present state.
Finding tells_state(Subject& subject, const std::string& number) {
    const Answer answer = subject.ask("%ST");
    if (auto fine = has_status(answer, "00"); !fine.passed()) return fine;
    const auto& lines = answer.message.lines;
    return require(lines.size() == 1 && lines.front() == number,
                   "%ST says " + (lines.empty() ? "nothing" : lines.front()) + ", not " + number);
}

Finding state_number(Subject& subject, const std::string& number, void (*go)(Subject&)) {
    if (!subject.facts().knows("%ST")) return not_applicable("it does not know %ST");
    subject.rest();
    go(subject);
    return tells_state(subject, number);
}

Finding twice_quit(Subject& subject) {
    subject.measure();
    if (auto first = subject.expect("QT", "00"); !first.passed()) return first;
    return subject.expect("QT", "00");
}

Finding really_off(Subject& subject) {
    subject.measure();
    (void)subject.ask("QT");
    return subject.expect("BM", "00");
}

Finding scan_after_bm(Subject& subject) {
    subject.measure();
    return is_scan(subject.ask("GD" + subject.window() + "01"));
}

Finding time_in_adjust(Subject& subject) {
    subject.adjust();
    const Answer answer = subject.ask("TM1");
    if (auto fine = has_status(answer, "00"); !fine.passed()) return fine;
    const auto& lines = answer.message.lines;
    return require(lines.size() == 1 && lines.front().size() == 4,
                   "TM1 does not bring one line of four characters");
}

Finding twice_adjust(Subject& subject) {
    return in_adjust(subject, "TM0", "02");
}

Finding adjust_without_laser(Subject& subject) {
    subject.measure();
    (void)subject.ask("TM0");
    (void)subject.ask("TM2");
    return subject.expect("BM", "00");
}

void go_nowhere(Subject& /*subject*/) {}
void go_measuring(Subject& subject) {
    subject.measure();
}
void go_streaming(Subject& subject) {
    subject.stream("MD" + subject.window() + "01000");
}
void go_adjusting(Subject& subject) {
    subject.adjust();
}

Finding at_rest(Subject& subject, const std::string& request, std::string_view status) {
    subject.rest();
    return subject.expect(request, status);
}

constexpr Check table_of_states[] = {
    {"4.1", "after QT the laser is off: GD is refused with 10", spec_bm,
     [](Subject& subject) { return at_rest(subject, "GD" + subject.window() + "01", "10"); }},
    {"4.2", "BM switches the laser on", spec_bm,
     [](Subject& subject) { return at_rest(subject, "BM", "00"); }},
    {"4.3", "BM with the laser on is refused with 02", spec_bm,
     [](Subject& subject) {
         subject.measure();
         return subject.expect("BM", "02");
     }},
    {"4.4", "GD with the laser on brings a scan", spec_bm, scan_after_bm},
    {"4.5", "QT is answered with 00, whether the laser is on or off", spec_bm, twice_quit},
    {"4.6", "QT switches the laser off: BM is accepted again", spec_bm, really_off},
    {"4.7", "%ST says 000 at rest", "hokuyolx",
     [](Subject& subject) { return state_number(subject, "000", go_nowhere); }},
    {"4.8", "%ST says 003 with the laser on", "hokuyolx",
     [](Subject& subject) { return state_number(subject, "003", go_measuring); }},
    {"4.9", "%ST says 004 in a stream", "hokuyolx",
     [](Subject& subject) { return state_number(subject, "004", go_streaming); }},
    {"4.10", "%ST says 002 in adjust mode", "hokuyolx",
     [](Subject& subject) { return state_number(subject, "002", go_adjusting); }},
    {"4.11", "TM0 enters adjust mode", spec_tm,
     [](Subject& subject) { return at_rest(subject, "TM0", "00"); }},
    {"4.12",
     "TM0 in adjust mode is refused with 02",
     spec_tm,
     twice_adjust,
     {{{Line::ethernet_multi_echo, "00", "a UTM-30LX-EW (urg_stamped #115)"}}}},
    {"4.13", "TM1 brings the time in four characters", spec_tm, time_in_adjust},
    {"4.14", "TM2 leaves adjust mode", spec_tm,
     [](Subject& subject) { return in_adjust(subject, "TM2", "00"); }},
    {"4.15", "TM2 outside adjust mode is refused with 03", spec_tm,
     [](Subject& subject) { return at_rest(subject, "TM2", "03"); }},
    {"4.16",
     "TM1 outside adjust mode is refused with 04",
     spec_tm,
     [](Subject& subject) { return at_rest(subject, "TM1", "04"); },
     {{{Line::ethernet_multi_echo, "00", on_ethernet}, {Line::ust, "00", on_ethernet}}}},
    {"4.17", "TM3 is refused with 01", spec_tm,
     [](Subject& subject) { return at_rest(subject, "TM3", "01"); }},
    {"4.18", "TM0 switches the laser off: BM is accepted again", spec_tm, adjust_without_laser},
    {"4.19",
     "VV in adjust mode is refused with 0E",
     only_tm,
     [](Subject& subject) { return in_adjust(subject, "VV", "0E"); },
     {{{Line::ethernet_multi_echo, "00", on_ethernet}, {Line::ust, "00", on_ethernet}}}},
    {"4.20",
     "PP in adjust mode is refused with 0E",
     only_tm,
     [](Subject& subject) { return in_adjust(subject, "PP", "0E"); },
     {{{Line::ethernet_multi_echo, "10", "hokuyolx"}, {Line::ust, "10", "hokuyolx"}}}},
    {"4.21",
     "BM in adjust mode is refused with 0E",
     only_tm,
     [](Subject& subject) { return in_adjust(subject, "BM", "0E"); },
     {{{Line::ethernet_multi_echo, "10", on_ethernet}, {Line::ust, "10", on_ethernet}}}},
    {"4.22",
     "GD in adjust mode is refused with 0E",
     only_tm,
     [](Subject& subject) { return in_adjust(subject, "GD" + subject.window() + "01", "0E"); },
     {{{Line::ethernet_multi_echo, "10", on_ethernet}, {Line::ust, "10", on_ethernet}}}},
    {"4.23",
     "MD in adjust mode is refused with 0E",
     only_tm,
     [](Subject& subject) { return in_adjust(subject, "MD" + subject.window() + "01001", "0E"); },
     {{{Line::ethernet_multi_echo, "10", on_ethernet}, {Line::ust, "10", on_ethernet}}}},
    {"4.24",
     "QT in adjust mode is refused with 0E",
     only_tm,
     [](Subject& subject) { return in_adjust(subject, "QT", "0E"); },
     {{{Line::ethernet_multi_echo, "00", "a UTM-30LX-EW leaves it (urg_stamped #115)"},
       {Line::ust, "10", "UrgBenri; urg_stamped's simulator"}}}},
};

}  // namespace

std::span<const Check> state_checks() {
    return table_of_states;
}

}  // namespace scipd::tools::checks
