// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Requests that do not wait for the reply to the one before.
#include <string>
#include <vector>

#include "tools/scipcat/check/check_table.h"

namespace scipd::tools::checks {
namespace {

constexpr std::string_view spec_queue = "SCIP 2.0 (C-42-03320B) p. 10";

/// Sends all in one write, and expects their replies in this order.
Finding in_order(Subject& subject, const std::vector<std::string>& requests) {
    subject.rest();
    std::string bytes;
    for (const std::string& request : requests)
        bytes += request + "\n";
    subject.wire().send(bytes);
    for (const std::string& request : requests) {
        const Answer answer = subject.next();
        if (answer.message.echo != request)
            return fail("where " + request + " should be answered, the echo is " +
                        answer.message.echo);
        if (answer.message.damage || answer.status() != "00")
            return fail(request + " is not answered with 00");
    }
    return pass();
}

Finding of_one_kind(Subject& subject) {
    subject.rest();
    subject.wire().send("VV\nVV\nVV\n");
    for (int i = 0; i < 3; ++i) {
        const Answer answer = subject.next();
        if (answer.message.echo != "VV") return fail("an echo is " + answer.message.echo);
        if (auto fine = has_status(answer, "00"); !fine.passed()) return fine;
    }
    return pass();
}

Finding both_in_order(Subject& subject) {
    return in_order(subject, {"VV", "PP"});
}

Finding behind_stream(Subject& subject) {
    subject.rest();
    const std::string version = subject.ask("VV").raw;
    const std::string request = "MD" + subject.window() + "0100";
    subject.wire().send(request + "3\nVV\n");
    if (subject.next().raw != request + "3\n00P\n\n") return fail("MD is not acknowledged first");
    int scans = 0;
    int versions = 0;
    while (scans + versions < 4) {
        const Answer answer = subject.next_scan();
        if (answer.raw == version) {
            ++versions;
        } else if (auto fine = is_scan(answer, request + std::to_string(2 - scans++));
                   !fine.passed()) {
            return fine;
        }
    }
    return require(scans == 3 && versions == 1, "VV is not answered once");
}

Finding quit_behind_stream(Subject& subject) {
    subject.rest();
    const std::string request = "MD" + subject.window() + "01000";
    subject.wire().send(request + "\nQT\n");
    if (subject.next().raw != request + "\n00P\n\n") return fail("MD is not acknowledged first");
    Answer answer = subject.next_scan();
    for (int i = 0; i < 2 && answer.message.echo == request; ++i)
        answer = subject.next_scan();
    if (answer.raw != "QT\n00P\n\n") return fail("QT right behind MD does not end the stream");
    return require(subject.wire().quiet_for(subject.turns(4)), "more comes after QT");
}

constexpr Check table_of_pipelining[] = {
    {"11.1", "two requests in one write are answered in order", spec_queue, both_in_order},
    {"11.2", "eight requests in one write are answered in order", spec_queue,
     [](Subject& subject) {
         return in_order(subject, {"VV", "PP", "II", "QT", "VV;a", "PP;b", "II;c", "QT;d"});
     }},
    {"11.3",
     "a request may be repeated before it is answered",
     "all drivers that repeat QT",
     of_one_kind,
     {{{Line::any, "0B", "SCIP 2.0 (C-42-03320B) p. 10 allows it"}}}},
    {"11.4", "a request right behind MD is answered between whole messages", spec_queue,
     behind_stream},
    {"11.5", "QT, BM and GD in one write bring a scan", spec_queue,
     [](Subject& subject) {
         return in_order(subject, {"QT", "BM", "GD" + subject.window() + "01", "QT"});
     }},
    {"11.6", "QT right behind MD ends the stream", "urg_library", quit_behind_stream},
};

}  // namespace

std::span<const Check> pipelining_checks() {
    return table_of_pipelining;
}

}  // namespace scipd::tools::checks
