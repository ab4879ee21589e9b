// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The language that old units wake up in: statuses of one character, and no sums.
#include <string>

#include "tools/scipcat/check/check_table.h"

namespace scipd::tools::checks {
namespace {

constexpr std::string_view recorded_scip1 = "recorded URG-04LX 3.1.04 (Player's hokuyo_aist.logr)";

Finding in_scip2() {
    return not_applicable("it speaks SCIP 2 from the start");
}

/// What answers these bytes, or nothing.
std::string answer_in_scip1(Subject& subject, const std::string& request) {
    (void)subject.wire().listen(std::chrono::milliseconds(0));
    subject.wire().send(request + "\n");
    return subject.wire().message().value_or("");
}

Finding scip1_version(Subject& subject) {
    if (!subject.speaks_scip1()) return in_scip2();
    const auto lines = read_answer(answer_in_scip1(subject, "V")).lines();
    constexpr std::string_view keys[] = {"VEND:", "PROD:", "FIRM:", "PROT:", "SERI:", "STAT:"};
    if (lines.size() != 2 + std::size(keys) || lines[0] != "V" || lines[1] != "0")
        return fail("V is not answered with V, 0 and six lines");
    for (std::size_t i = 0; i < std::size(keys); ++i) {
        if (!lines[i + 2].starts_with(keys[i]))
            return fail("line " + std::to_string(i + 3) + " does not begin with " +
                        std::string(keys[i]));
    }
    return pass();
}

Finding scip1_scan(Subject& subject) {
    if (!subject.speaks_scip1()) return in_scip2();
    constexpr std::size_t steps = 769;
    constexpr std::size_t width = 2;
    constexpr std::size_t line_length = 64;
    const auto lines = read_answer(answer_in_scip1(subject, "G00076801")).lines();
    if (lines.size() < 3 || lines[0] != "G00076801" || lines[1] != "0")
        return fail("G00076801 is not answered with its echo, 0 and data");
    std::size_t characters = 0;
    for (std::size_t i = 2; i < lines.size(); ++i) {
        if (i + 1 < lines.size() && lines[i].size() != line_length)
            return fail("line " + std::to_string(i + 1) + " has not 64 characters");
        characters += lines[i].size();
    }
    return require(characters == steps * width,
                   "769 steps are " + std::to_string(characters) + " characters, not 1538");
}

Finding scip1_unknown(Subject& subject) {
    if (!subject.speaks_scip1()) return in_scip2();
    return require(answer_in_scip1(subject, "QT") == "QT\nE\n\n", "QT is not answered with E");
}

Finding scip1_leaving(Subject& subject) {
    if (!subject.speaks_scip1()) return in_scip2();
    if (answer_in_scip1(subject, "SCIP2.0") != "SCIP2.0\n0\n\n")
        return fail("SCIP2.0 is not answered with 0");
    return require(answer_in_scip1(subject, "QT") == "QT\n00P\n\n",
                   "QT is not answered in SCIP 2 after SCIP2.0");
}

constexpr Check table_of_scip1[] = {
    {"1.1", "V tells VEND, PROD, FIRM, PROT, SERI and STAT, without sums", recorded_scip1,
     scip1_version},
    {"1.2", "G brings every step in two characters, in lines of 64 without sums",
     "recorded URG-04LX 3.3.00 (regilo)", scip1_scan},
    {"1.3", "QT, which SCIP 1.1 does not know, is answered with E", "urg_library, UrgBenri",
     scip1_unknown},
    {"1.4", "SCIP2.0 is answered with 0, and from then on it speaks SCIP 2", recorded_scip1,
     scip1_leaving},
};

}  // namespace

std::span<const Check> scip1_checks() {
    return table_of_scip1;
}

}  // namespace scipd::tools::checks
