// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Scan after scan: MD and its kin, and what is asked meanwhile.
#include <cmath>
#include <string>

#include "tools/scipcat/check/check_table.h"

namespace scipd::tools::checks {
namespace {

constexpr std::string_view spec_stream = "SCIP 2.0 (C-42-03320B) p. 10, 11; C-42-04076 p. 6";

std::string endless(const Subject& subject, const std::string& command = "MD") {
    return command + subject.window() + "01000";
}

Finding acknowledged(Subject& subject) {
    subject.rest();
    const std::string request = "MD" + subject.window() + "01001";
    const std::string raw = subject.ask(request).raw;
    return require(raw == request + "\n00P\n\n",
                   "the acknowledgement is not the request, 00P and an empty line");
}

Finding over_after_count(Subject& subject) {
    subject.rest();
    subject.stream("MD" + subject.window() + "01002");
    (void)subject.scans(2);
    if (!subject.wire().quiet_for(subject.turns(4)))
        return fail("more comes after the last scan of a counted stream");
    return subject.expect_laser_off();
}

Finding endless_echo(Subject& subject) {
    subject.rest();
    subject.stream(endless(subject));
    for (int i = 0; i < 3; ++i) {
        if (auto fine = is_scan(subject.next_scan(), endless(subject)); !fine.passed()) return fine;
    }
    return pass();
}

Finding laser_by_itself(Subject& subject) {
    subject.rest();
    subject.stream(endless(subject));
    (void)subject.scans(1);
    return subject.expect("BM", "02");
}

Finding quits(Subject& subject) {
    constexpr std::size_t most_before = 2;
    subject.rest();
    subject.stream(endless(subject));
    (void)subject.scans(2);
    const Answer answer = subject.ask("QT");
    if (auto fine = has_status(answer, "00"); !fine.passed()) return fine;
    if (answer.before.size() > most_before)
        return fail(std::to_string(answer.before.size()) + " scans come before the reply to QT");
    return require(subject.wire().quiet_for(subject.turns(4)), "more comes after QT");
}

/// Passes over so many turns between two scans.
Finding skips(Subject& subject, int interval) {
    constexpr double tolerance = 0.25;  // of a turn
    subject.rest();
    subject.stream("MD" + subject.window() + "01" + std::to_string(interval) + "03");
    const auto scans = subject.scans(3);
    for (std::size_t i = 1; i < scans.size(); ++i) {
        const double turns =
            since(scans[i - 1].stamp_ms, scans[i].stamp_ms) / subject.facts().period_ms();
        if (std::abs(turns - interval - 1) > tolerance + 0.01 * interval)
            return fail("scans are " + tenths(turns) + " turns apart, not " +
                        std::to_string(interval + 1));
    }
    return pass();
}

/// Whether such scans have as many values as they announce.
Finding streams(Subject& subject, const std::string& command) {
    if (!subject.facts().knows(command)) return not_applicable("it does not know " + command);
    return subject.expect_scans(command + subject.all() + "010", 2);
}

Finding whole_scans(Subject& subject) {
    constexpr int count = 10;
    subject.rest();
    subject.stream("MD" + subject.all() + "01000");
    (void)subject.scans(count);
    return pass();
}

Finding answers_between(Subject& subject) {
    subject.rest();
    const std::string version = subject.ask("VV").raw;
    subject.stream(endless(subject));
    (void)subject.scans(1);
    const Answer answer = subject.ask("VV");
    for (const std::string& raw : answer.before) {
        if (auto fine = is_scan(read_answer(raw), endless(subject)); !fine.passed()) return fine;
    }
    if (answer.raw != version) return fail("VV is answered with something else than at rest");
    (void)subject.scans(2);
    return pass();
}

Finding replaces(Subject& subject) {
    constexpr int steps = 5;
    subject.rest();
    subject.stream(endless(subject));
    (void)subject.scans(1);
    const std::string other = "MD" + subject.window(steps) + "01000";
    if (other == endless(subject)) return not_applicable("it has one step only");
    subject.stream(other);
    for (int i = 0; i < 3; ++i) {
        if (auto fine = is_scan(subject.next_scan(), other); !fine.passed()) return fine;
    }
    return pass();
}

Finding laser_on_meanwhile(Subject& subject) {
    subject.rest();
    subject.stream(endless(subject));
    (void)subject.scans(1);
    Facts facts;
    take_texts(facts, subject.ask("II").raw);
    return require(facts.text("LASR") == "ON", "II in a stream says LASR:" + facts.text("LASR"));
}

Finding named_scans(Subject& subject) {
    subject.rest();
    const std::string request = "MD" + subject.window() + "0100";
    subject.stream(request + "2;ab 1");
    for (const std::string& echo : {request + "1;ab 1", request + "0;ab 1"}) {
        const std::string came = subject.next_scan().message.echo;
        if (came != echo) return fail("the echo of a scan is " + came + ", not " + echo);
    }
    return pass();
}

Finding reset_ends(Subject& subject) {
    if (subject.on_serial_line()) return not_applicable("RS would change the rate of its line");
    subject.rest();
    subject.stream(endless(subject));
    (void)subject.scans(1);
    if (auto fine = subject.expect("RS", "00"); !fine.passed()) return fine;
    if (!subject.wire().quiet_for(subject.turns(4))) return fail("more comes after RS");
    return subject.expect_laser_off();
}

constexpr Check table_of_streams[] = {
    {"6.1", "MD is acknowledged with its own digits and 00", "recorded UTM-30LX", acknowledged},
    {"6.2", "a counted stream has status 99 and counts down to 00", spec_stream,
     [](Subject& subject) { return subject.expect_scans("MD" + subject.window() + "010", 3); }},
    {"6.3", "after the last counted scan nothing comes, and the laser is off", spec_stream,
     over_after_count},
    {"6.4", "each scan of an endless stream says 00", "recorded UST; urg_stamped", endless_echo},
    {"6.5", "MD switches the laser on by itself", spec_stream, laser_by_itself},
    {"6.6", "QT ends a stream: at most two scans come before its reply, and none after it",
     "urg_library", quits},
    {"6.7", "an interval of 1 leaves out every second turn", spec_stream,
     [](Subject& subject) { return skips(subject, 1); }},
    {"6.8", "an interval of 3 leaves out three turns of four", spec_stream,
     [](Subject& subject) { return skips(subject, 3); }},
    {"6.9", "MS streams two characters a step", spec_stream,
     [](Subject& subject) { return streams(subject, "MS"); }},
    {"6.10", "ME streams distances and intensities", "recorded UTM-30LX",
     [](Subject& subject) { return streams(subject, "ME"); }},
    {"6.11", "ND streams echoes", "urg_library",
     [](Subject& subject) { return streams(subject, "ND"); }},
    {"6.12", "NE streams echoes and intensities", "urg_library",
     [](Subject& subject) { return streams(subject, "NE"); }},
    {"6.13", "MF streams inputs, outputs and distances", "urg_library 1.2.6",
     [](Subject& subject) { return streams(subject, "MF"); }},
    {"6.14", "MG streams inputs, outputs, distances and intensities", "urg_library 1.2.6",
     [](Subject& subject) { return streams(subject, "MG"); }},
    {"6.15", "ten whole scans come without a wrong sum or length", spec_stream, whole_scans},
    {"6.16", "VV in mid-stream is answered between two whole scans", "urg_library",
     answers_between},
    {"6.17", "MD in mid-stream takes the place of the stream", "urg_library, urg_stamped",
     replaces},
    {"6.18", "II in mid-stream says that the laser is on", "recorded URG-04LX", laser_on_meanwhile},
    {"6.19", "a string comes back with each scan", spec_stream, named_scans},
    {"6.20", "RS ends a stream and switches the laser off", "SCIP 2.0 (C-42-03320B) p. 14",
     reset_ends},
};

}  // namespace

std::span<const Check> stream_checks() {
    return table_of_streams;
}

}  // namespace scipd::tools::checks
