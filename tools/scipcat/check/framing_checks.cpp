// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How replies are framed, and the sum of each line.
#include <string>

#include "protocol/checksum.h"
#include "tools/scipcat/check/check_table.h"

namespace scipd::tools::checks {
namespace {

constexpr std::string_view spec_framing = "SCIP 2.0 (C-42-03320B) p. 9 to 12; all recordings";
constexpr std::size_t full_line = 64;

/// The sum of KEY:VALUE;s does not include the semicolon.
Finding sums_of_entries(Subject& subject, const std::string& request) {
    subject.rest();
    const auto lines = subject.ask(request).lines();
    for (std::size_t i = 2; i < lines.size(); ++i) {
        const std::string& line = lines[i];
        const std::string text =
            line.substr(0, line.size() - std::min<std::size_t>(2, line.size()));
        if (line != text + ";" + protocol::checksum(text))
            return fail("line " + std::to_string(i + 1) + " of " + request +
                        " does not end with ; and its sum");
    }
    return require(lines.size() > 2, request + " has no lines");
}

Finding sums_of_scan(Subject& subject) {
    const auto lines = subject.scan(subject.all()).lines();
    if (lines.size() < 4) return fail("a scan has no time stamp and data");
    for (std::size_t i = 1; i < lines.size(); ++i) {
        const std::string text = lines[i].substr(0, lines[i].empty() ? 0 : lines[i].size() - 1);
        if (lines[i].empty() || lines[i].back() != protocol::checksum(text))
            return fail("line " + std::to_string(i + 1) + " does not end with its sum");
    }
    return pass();
}

Finding full_lines(Subject& subject) {
    const auto lines = subject.scan(subject.all()).lines();
    for (std::size_t i = 3; i + 1 < lines.size(); ++i) {
        if (lines[i].size() != full_line + 1)
            return fail("line " + std::to_string(i + 1) + " has " +
                        std::to_string(lines[i].size() - 1) + " characters before its sum, not 64");
    }
    const bool ends =
        lines.size() > 3 && lines.back().size() > 1 && lines.back().size() <= full_line + 1;
    return require(ends, "the last line has not 1 to 64 characters before its sum");
}

Finding exact_lines(Subject& subject) {
    if (subject.facts().steps() < static_cast<int>(full_line))
        return not_applicable("it has fewer than 64 steps");
    const auto lines = subject.scan(subject.window(full_line)).lines();
    return require(lines.size() == 6 && lines.back().size() == full_line + 1,
                   "64 steps in three characters are not three lines of 64");
}

Finding exact_echo(Subject& subject) {
    subject.rest();
    subject.wire().send("VV\n");
    const auto lines = subject.next().lines();
    return require(!lines.empty() && lines.front() == "VV", "VV comes back in another form");
}

Finding status_with_sum(Subject& subject) {
    subject.rest();
    const std::string raw = subject.ask("QT").raw;
    return require(raw == "QT\n00P\n\n", "QT is not answered with QT, 00P and an empty line");
}

Finding no_carriage_return(Subject& subject) {
    subject.rest();
    for (const char* const request : {"VV", "PP", "II", "QT"}) {
        subject.wire().send(std::string(request) + "\n");
        const auto raw = subject.wire().message();
        if (!raw || raw->find('\r') != std::string::npos)
            return fail(std::string(request) + " is answered with other line ends than LF");
    }
    return pass();
}

Finding bare_refusal(Subject& subject) {
    subject.rest();
    const Answer answer = subject.ask("GD9999999901");
    return require(answer.lines().size() == 2 && answer.status() != "00",
                   "a refusal has more than echo, status and an empty line");
}

Finding silence(Subject& subject) {
    subject.rest();
    (void)subject.ask("VV");
    return require(subject.wire().quiet_for(std::chrono::milliseconds(250)),
                   "bytes come that nobody asked for");
}

constexpr Check table_of_framing[] = {
    {"3.1", "the reply to QT is echo, status with its sum, empty line", spec_framing,
     status_with_sum},
    {"3.2", "each line of VV ends with ; and the sum of what stands before it", spec_framing,
     [](Subject& subject) { return sums_of_entries(subject, "VV"); }},
    {"3.3", "each line of PP ends with ; and the sum of what stands before it", spec_framing,
     [](Subject& subject) { return sums_of_entries(subject, "PP"); }},
    {"3.4", "each line of II ends with ; and the sum of what stands before it", spec_framing,
     [](Subject& subject) { return sums_of_entries(subject, "II"); }},
    {"3.5", "the time stamp and each data line of a scan end with their sum", spec_framing,
     sums_of_scan},
    {"3.6", "the echo is the request without a sum", spec_framing, exact_echo},
    {"3.7", "data are cut into lines of 64 characters", spec_framing, full_lines},
    {"3.8", "data that fill their lines have no empty line of their own", spec_framing,
     exact_lines},
    {"3.9", "replies have LF alone", "C-42-03320B p. 9; C-42-04076 p. 3", no_carriage_return},
    {"3.10", "a refusal is echo, status and empty line alone",
     "recorded URG-04LX (HS0) and UTM-30LX (CR00)", bare_refusal},
    {"3.11", "nothing comes that nobody asked for", spec_framing, silence},
};

}  // namespace

std::span<const Check> framing_checks() {
    return table_of_framing;
}

}  // namespace scipd::tools::checks
