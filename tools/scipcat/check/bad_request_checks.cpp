// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Requests that a scanner must refuse, and how.
#include <set>
#include <string>

#include "tools/scipcat/check/check_table.h"

namespace scipd::tools::checks {
namespace {

constexpr std::string_view spec_statuses = "SCIP 2.0 (C-42-03320B) p. 23";
constexpr std::string_view spec_parameters = "SCIP 2.0 (C-42-03320B) p. 10, 11";
constexpr std::string_view short_on_ust = "canned replies of a real UST-10LX";

Finding refuses(Subject& subject, const std::string& request, std::string_view status) {
    subject.rest();
    return subject.expect(request, status);
}

/// First and last step, with letters in one of them; and the rest of an MD request.
std::string malformed(const Subject& subject, std::size_t place) {
    std::string request = "MD" + subject.window() + "01001";
    request.at(place) = 'x';
    return request;
}

std::string backwards(const Subject& subject) {
    const std::string digits = subject.window(2);
    return "MD" + digits.substr(4) + digits.substr(0, 4) + "01001";
}

Finding fine_string(Subject& subject) {
    return refuses(subject, "QT;Az09 ._+@abcdefg", "00");
}

Finding state_before_length(Subject& subject) {
    if (subject.facts().line != Line::ust) return not_applicable("this is known of the UST alone");
    return refuses(subject, "GD", "10");
}

Finding nothing_changed(Subject& subject) {
    subject.rest();
    for (const std::string& request : {std::string("MD9999999901000"), std::string("MD")}) {
        if (subject.ask(request).status() == "00") return fail(request + " is accepted");
    }
    return subject.expect_laser_off();
}

/// Whatever it makes of these bytes, the next request is answered.
Finding survives(Subject& subject, const std::string& bytes) {
    subject.rest();
    const std::string version = subject.ask("VV").raw;
    subject.wire().send(bytes + "\n");
    const std::string refusal = subject.wire().listen(std::chrono::milliseconds(150));
    if (read_answer(refusal).status() == "00") return fail("it accepts such bytes");
    const Answer answer = subject.ask("VV");
    return require(answer.raw == version, "VV is answered with something else afterwards");
}

Finding answers_scip2(Subject& subject) {
    subject.rest();
    const Answer answer = subject.ask("SCIP2.0");
    const auto lines = answer.lines();
    return require(lines.size() == 2 && lines[1].starts_with('0'),
                   "SCIP2.0 is not answered with a status that begins with 0");
}

std::set<std::string> commands_of(Line line) {
    switch (line) {
        case Line::urg:
            return {"GD", "GS", "MD", "MS"};
        case Line::utm_usb:
            return {"GD", "GE", "MD", "ME"};
        case Line::ethernet_multi_echo:
            return {"GD", "GE", "HD", "HE", "MD", "ME", "ND", "NE"};
        default:
            return {"GD", "GE", "MD", "ME"};
    }
}

// GS and MS of the UTM on USB are in no recording, and only the UXM-30LX-E of that line has echoes.
Finding scan_commands(Subject& subject) {
    const Line line = subject.facts().line;
    if (line == Line::other) return not_applicable("what such a product knows is not known");
    std::set<std::string> asked = {"GD", "GS", "GE", "HD", "HE", "MD", "MS", "ME", "ND", "NE"};
    if (line == Line::utm_usb) asked = commands_of(line);
    const auto known = commands_of(line);
    subject.rest();
    for (const std::string& command : asked) {
        const bool refused = is_unknown(subject.ask(command).status());
        if (refused == (known.count(command) == 1))
            return fail(command + (refused ? " is unknown to it" : " is known to it") +
                        ", unlike to others of its line");
    }
    return pass();
}

constexpr Check table_of_bad_requests[] = {
    {"9.1",
     "an unknown command is refused with 0E",
     spec_statuses,
     [](Subject& subject) { return refuses(subject, "XX", "0E"); },
     {{{Line::ust, "0F", "a real UST-10LX 2.23"}}}},
    {"9.2",
     "commands in lower case are unknown",
     spec_statuses,
     [](Subject& subject) { return refuses(subject, "vv", "0E"); },
     {{{Line::ust, "0F", "a real UST-10LX 2.23"}}}},
    {"9.3", "a request that lacks parameters is refused with 0C", spec_statuses,
     [](Subject& subject) { return refuses(subject, "MD", "0C"); }},
    {"9.4",
     "a request with too much behind it is refused with 0D",
     spec_statuses,
     [](Subject& subject) { return refuses(subject, "VV1", "0D"); },
     {{{Line::urg, "0F", "SCIP 2.0 (C-42-03320B) p. 23, read otherwise"},
       {Line::utm_usb, "0F", "SCIP 2.0 (C-42-03320B) p. 23, read otherwise"}}}},
    {"9.5", "a first step with letters is refused with 01", spec_parameters,
     [](Subject& subject) { return refuses(subject, malformed(subject, 2), "01"); }},
    {"9.6", "a last step with letters is refused with 02", spec_parameters,
     [](Subject& subject) { return refuses(subject, malformed(subject, 6), "02"); }},
    {"9.7", "a cluster with letters is refused with 03", spec_parameters,
     [](Subject& subject) { return refuses(subject, malformed(subject, 10), "03"); }},
    {"9.8", "an interval that is a letter is refused with 06", spec_parameters,
     [](Subject& subject) { return refuses(subject, malformed(subject, 12), "06"); }},
    {"9.9", "a number of scans with letters is refused with 07", spec_parameters,
     [](Subject& subject) { return refuses(subject, malformed(subject, 13), "07"); }},
    {"9.10", "a last step beyond all steps is refused with 04", spec_parameters,
     [](Subject& subject) { return refuses(subject, "MD0000999901001", "04"); }},
    {"9.11", "a last step before the first is refused with 05", spec_parameters,
     [](Subject& subject) {
         if (subject.facts().steps() < 2) return not_applicable("it has one step only");
         return refuses(subject, backwards(subject), "05");
     }},
    {"9.12", "a string of 17 characters is refused with 0G", "SCIP 2.0 (C-42-03320B) p. 9, 23",
     [](Subject& subject) { return refuses(subject, "QT;0123456789abcdefg", "0G"); }},
    {"9.13", "a string with other characters than letters, digits, blank . _ + @ gets 0H",
     "SCIP 2.0 (C-42-03320B) p. 9, 23",
     [](Subject& subject) { return refuses(subject, "QT;a-b", "0H"); }},
    {"9.14", "a string of 16 of these characters comes back", "SCIP 2.0 (C-42-03320B) p. 9",
     fine_string},
    {"9.15", "GD alone with the laser off is refused for the laser, not for its length",
     short_on_ust, state_before_length},
    {"9.16", "what is refused changes nothing", spec_statuses, nothing_changed},
    {"9.17", "300 characters without a line end harm nobody", "none: robustness",
     [](Subject& subject) { return survives(subject, std::string(300, 'x')); }},
    {"9.18", "control characters harm nobody", "none: robustness",
     [](Subject& subject) { return survives(subject, "\x01\x7f\x1b[\xff"); }},
    {"9.19", "SCIP2.0 in SCIP 2 gets a status that begins with 0", "MRPT, which waits for it",
     answers_scip2},
    {"9.20", "it knows the scan commands of its line", "UrgBenri, which tries each alone",
     scan_commands},
};

}  // namespace

std::span<const Check> bad_request_checks() {
    return table_of_bad_requests;
}

}  // namespace scipd::tools::checks
