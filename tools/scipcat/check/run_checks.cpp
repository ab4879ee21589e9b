// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/check/run_checks.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <thread>
#include <utility>

#include "protocol/client/error.h"
#include "tools/scip_transport.h"

namespace scipd::tools::checks {
namespace {

using protocol::client::Error;

struct Planned {
    const Chapter* chapter;
    const Check* check;
};

/// Commands that the scanner does not know, each with the number of the check that failed for it.
using Counted = std::map<std::string, std::string_view>;

/// All checks of these sections, the unsafe ones as well: they say why they were not made.
std::vector<Planned> plan(const Wanted& wanted) {
    std::vector<Planned> planned;
    for (const Chapter& chapter : chapters()) {
        for (const Check& check : chapter.checks) {
            const bool asked = std::ranges::any_of(
                wanted.sections, [&](const auto& s) { return belongs_to(check.id, s); });
            if (wanted.sections.empty() || asked) planned.push_back({&chapter, &check});
        }
    }
    return planned;
}

/// A refusal that is known of its line is no failure.
Finding judged(Finding finding, const Check& check, Line line) {
    if (finding.verdict != Verdict::fail || finding.came.empty()) return finding;
    for (const KnownDifference& known : check.known) {
        const bool its_line = known.line == line || known.line == Line::any;
        if (its_line && known.status == finding.came) {
            finding.verdict = Verdict::differs;
            finding.why += ", as is known: " + std::string(known.source);
            return finding;
        }
    }
    return finding;
}

Finding look(const Planned& planned, Subject& subject, const Wanted& wanted) {
    if (planned.chapter->unsafe && !wanted.unsafe)
        return skipped("it changes settings or reboots; --unsafe makes it");
    if (subject.speaks_scip1() && planned.chapter != chapters().data())
        return not_applicable("it speaks SCIP 1.1 alone");
    if (subject.wire().over()) return fail("no time was left: the scanner answers too slowly");
    try {
        return judged(planned.check->look(subject), *planned.check, subject.facts().line);
    } catch (const Error& error) {
        if (error.kind() == Error::Kind::closed) subject.wire().hang_up();
        return fail(error.what());
    }
}

/// A command that the scanner does not know fails the first check that needs it, and no other.
Finding counted_once(Finding finding, const Check& check, const Subject& subject,
                     Counted& counted) {
    if (finding.verdict != Verdict::fail || subject.lacking().empty()) return finding;
    const auto known = counted.find(subject.lacking().back());
    if (known != counted.end())
        return skipped("it needs " + known->first + ", which the scanner does not know (" +
                       std::string(known->second) + ")");
    for (const std::string& command : subject.lacking())
        counted.emplace(command, check.id);
    return finding;
}

Result make(const Planned& planned, Subject& subject, const Wanted& wanted, Counted& counted) {
    const auto begun = Clock::now();
    subject.begin();
    Finding finding =
        counted_once(look(planned, subject, wanted), *planned.check, subject, counted);
    const double seconds = std::chrono::duration<double>(Clock::now() - begun).count();
    return {planned.chapter,
            planned.check,
            std::move(finding),
            printable(subject.wire().sent()),
            printable(subject.wire().got()),
            seconds};
}

/// As it was found: laser off, no stream. A scanner that is gone needs nothing.
void leave_at_rest(Subject& subject) {
    try {
        subject.rest();
    } catch (const Error&) {
    }
}

/// False if that fails: the checks then go by what little is known, and fail as well.
bool introduce(Subject& subject) {
    try {
        subject.introduce();
        return true;
    } catch (const Error&) {
        subject.wire().hang_up();
        return false;
    }
}

/// The reason why not even a new connection reaches the scanner; empty: it answers, or no time is
/// left.
std::string why_gone(Subject& subject) {
    constexpr int fewest_tries = 2;
    constexpr std::chrono::milliseconds longest{2000};
    constexpr std::chrono::milliseconds pause{200};
    const auto end = Clock::now() + longest;
    for (int tries = 1; !subject.wire().over(); ++tries) {
        std::string why = "nothing answers QT";
        try {
            if (subject.responds()) return "";
        } catch (const Error& error) {
            why = error.what();
        }
        subject.wire().hang_up();
        if (tries < fewest_tries) continue;
        if (Clock::now() >= end) return why;
        std::this_thread::sleep_for(pause);
    }
    return "";
}

/// False if the scanner has gone; the report says so.
bool is_there(Subject& subject, CheckReport& report) {
    const std::string last = printable(subject.wire().last_line_sent());
    const std::string why = why_gone(subject);
    if (!why.empty())
        report.gone = "the scanner has gone" + (last.empty() ? "" : " after " + last) + ": " + why;
    return why.empty();
}

void make_all(Subject& subject, const Wanted& wanted, const Progress& progress,
              CheckReport& report) {
    const std::vector<Planned> planned = plan(wanted);
    Counted counted;
    bool introduced = false;
    for (const Planned& next : planned) {
        // SCIP 1.1 comes first, before it is left.
        const bool first = next.chapter != chapters().data() && !std::exchange(introduced, true);
        if (first && !introduce(subject) && !is_there(subject, report)) {
            report.results.push_back({next.chapter, next.check, fail(report.gone),
                                      printable(subject.wire().sent()),
                                      printable(subject.wire().got())});
            return;
        }
        progress(report.results.size(), planned.size(), *next.check);
        report.results.push_back(make(next, subject, wanted, counted));
        const bool failed = report.results.back().finding.verdict == Verdict::fail;
        const bool broke_off = failed || !subject.lacking().empty();
        const bool last = report.results.size() == planned.size();
        if (broke_off && !last && !is_there(subject, report)) return;
    }
    if (!introduced) (void)introduce(subject);
    if (!wanted.sections.empty() || subject.wire().over() || subject.speaks_scip1()) return;
    try {
        const NearestFirmware nearest = nearest_firmware(subject);
        if (!subject.wire().over()) report.nearest = nearest;
    } catch (const Error&) {  // it is gone: then it is like none
    }
}

}  // namespace

CheckReport run_checks(const Conversation::Place& place, const Wanted& wanted,
                       const Progress& progress) {
    Subject subject(place);
    CheckReport report;
    try {
        make_all(subject, wanted, progress, report);
    } catch (const Interrupted&) {
        report.interrupted = true;
    }
    if (report.gone.empty()) leave_at_rest(subject);
    report.facts = subject.facts();
    return report;
}

}  // namespace scipd::tools::checks
