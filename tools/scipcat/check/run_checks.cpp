// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/check/run_checks.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "protocol/client/error.h"
#include "tools/scip_transport.h"
#include "tools/scipcat/check/printable.h"

namespace scipd::tools::checks {
namespace {

using protocol::client::Error;

struct Planned {
    const Chapter* chapter;
    const Check* check;
};

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
        return not_applicable("it sets or reboots; --unsafe makes it");
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

Result make(const Planned& planned, Subject& subject, const Wanted& wanted) {
    const auto begun = Clock::now();
    subject.wire().begin();
    Finding finding = look(planned, subject, wanted);
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

/// Where that fails the checks go by what little is known, and fail as well.
void introduce(Subject& subject) {
    try {
        subject.introduce();
    } catch (const Error&) {
        subject.wire().hang_up();
    }
}

void make_all(Subject& subject, const Wanted& wanted, const Progress& progress,
              CheckReport& report) {
    const std::vector<Planned> planned = plan(wanted);
    bool introduced = false;
    for (const Planned& next : planned) {
        // SCIP 1.1 comes first, before it is left.
        if (next.chapter != chapters().data() && !std::exchange(introduced, true))
            introduce(subject);
        progress(report.results.size(), planned.size(), *next.check);
        report.results.push_back(make(next, subject, wanted));
    }
    if (!introduced) introduce(subject);
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
    leave_at_rest(subject);
    report.facts = subject.facts();
    return report;
}

}  // namespace scipd::tools::checks
