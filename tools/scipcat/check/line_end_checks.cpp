// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What ends a request, and requests that come in pieces.
#include <string>
#include <thread>

#include "tools/scipcat/check/check_table.h"

namespace scipd::tools::checks {
namespace {

using std::chrono::milliseconds;

constexpr std::string_view spec_ends = "SCIP 2.0 (C-42-03320B) p. 9; C-42-04076 p. 3";

/// Whether these bytes get the reply to VV, once, and nothing else.
Finding gets_version(Subject& subject, std::string_view bytes) {
    subject.rest();
    const std::string version = subject.ask("VV").raw;
    subject.wire().send(bytes);
    if (subject.next().raw != version) return fail("it does not answer as to VV with an LF");
    return require(subject.wire().quiet_for(milliseconds(150)), "it answers more than once");
}

Finding passes_over_empty_lines(Subject& subject) {
    subject.rest();
    subject.wire().send("\n\r\r\n\n");
    return require(subject.wire().quiet_for(milliseconds(250)), "it answers an empty line");
}

Finding takes_pieces(Subject& subject) {
    subject.rest();
    const std::string version = subject.ask("VV;ab").raw;
    for (const char c : std::string_view("VV;ab\n")) {
        subject.wire().send({&c, 1});
        std::this_thread::sleep_for(milliseconds(15));
    }
    return require(subject.next().raw == version, "it does not answer as to the request in one");
}

Finding waits_for_end(Subject& subject) {
    subject.rest();
    const std::string version = subject.ask("VV").raw;
    subject.wire().send("VV");
    if (!subject.wire().quiet_for(milliseconds(250)))
        return fail("it answers before the request has ended");
    subject.wire().send("\n");
    return require(subject.next().raw == version, "it does not answer as to the request in one");
}

constexpr Check table_of_line_ends[] = {
    {"10.1", "LF ends a request", spec_ends,
     [](Subject& subject) { return gets_version(subject, "VV\n"); }},
    {"10.2", "CR ends a request", spec_ends,
     [](Subject& subject) { return gets_version(subject, "VV\r"); }},
    {"10.3", "CR LF ends a request, once", spec_ends,
     [](Subject& subject) { return gets_version(subject, "VV\r\n"); }},
    {"10.4", "empty lines are passed over in silence", "urg_library, which begins with one",
     passes_over_empty_lines},
    {"10.5", "a request may come a character at a time", "hokuyoaist, which sends it in pieces",
     takes_pieces},
    {"10.6", "a request is answered when it has ended, and not before", spec_ends, waits_for_end},
};

}  // namespace

std::span<const Check> line_end_checks() {
    return table_of_line_ends;
}

}  // namespace scipd::tools::checks
