// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One scan a request: GD and its kin.
#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <thread>

#include "tools/scipcat/check/check_table.h"

namespace scipd::tools::checks {
namespace {

constexpr std::string_view spec_scan = "SCIP 2.0 (C-42-03320B) p. 10; all recordings";

/// Passes if a command that some scanners lack brings all steps.
Finding brings_all(Subject& subject, const std::string& command) {
    if (!subject.facts().knows(command)) return not_applicable("it does not know " + command);
    subject.measure();
    return is_scan(subject.ask(command + subject.all() + "01"));
}

Finding brings_echoes(Subject& subject, const std::string& command) {
    constexpr std::size_t most_further = 2;
    auto fine = brings_all(subject, command);
    if (!fine.passed()) return fine;
    const auto scan = scan_of(subject.ask(command + subject.all() + "01"));
    const bool few = std::ranges::all_of(
        scan.further_echoes, [](const auto& more) { return more.size() <= most_further; });
    return require(few, "a step has more than three echoes");
}

Finding outermost_steps(Subject& subject) {
    for (const int step : {subject.facts().amin, subject.facts().amax}) {
        const std::string digits =
            std::string(4 - std::to_string(step).size(), '0') + std::to_string(step);
        if (auto fine = is_scan(subject.scan(digits + digits)); !fine.passed()) return fine;
    }
    return pass();
}

// Codes are below DMIN, or 65533 to 65535.
Finding distances_or_codes(Subject& subject) {
    const auto scan = scan_of(subject.scan(subject.all()));
    const auto most = static_cast<std::uint32_t>(std::stoul("0" + subject.facts().text("DMAX")));
    const auto wrong = std::ranges::find_if(scan.distances_mm, [&](std::uint32_t value) {
        return value > most && (value < 65533 || value > 65535);
    });
    return require(wrong == scan.distances_mm.end(),
                   wrong == scan.distances_mm.end()
                       ? ""
                       : "a step reads " + std::to_string(*wrong) + ", beyond DMAX and no code");
}

Finding fresh_scans(Subject& subject) {
    subject.measure();
    std::set<std::uint32_t> stamps;
    constexpr int asked = 3;
    for (int i = 0; i < asked; ++i) {
        stamps.insert(scan_of(subject.ask("GD" + subject.window() + "01")).stamp_ms);
        std::this_thread::sleep_for(subject.turns(1.0));
    }
    return require(stamps.size() == asked, "GD once a turn brings the same time stamp again");
}

constexpr Check table_of_single_scans[] = {
    {"5.1", "GD brings each step in three characters", spec_scan,
     [](Subject& subject) { return brings_all(subject, "GD"); }},
    {"5.2", "GS brings each step in two characters", spec_scan,
     [](Subject& subject) { return brings_all(subject, "GS"); }},
    {"5.3", "GE brings distance and intensity of each step", "recorded UTM-30LX; urg_library",
     [](Subject& subject) { return brings_all(subject, "GE"); }},
    {"5.4", "HD brings one to three echoes of each step", "urg_library",
     [](Subject& subject) { return brings_echoes(subject, "HD"); }},
    {"5.5", "HE brings one to three echoes of each step, with intensities", "urg_library",
     [](Subject& subject) { return brings_echoes(subject, "HE"); }},
    {"5.6", "one step brings one value", spec_scan,
     [](Subject& subject) { return is_scan(subject.scan(subject.window(1))); }},
    {"5.7", "ten steps bring ten values", spec_scan,
     [](Subject& subject) { return is_scan(subject.scan(subject.window(10))); }},
    {"5.8", "the steps AMIN and AMAX can be asked for", spec_scan, outermost_steps},
    {"5.9", "values are at most DMAX, or codes",
     "SCIP 2.0 (C-42-03320B) p. 12; data sheet of the UST-10LX", distances_or_codes},
    {"5.10", "GD asked for once a turn brings another scan each time",
     "hokuyo_node and Rock's driver take equal time stamps for an error", fresh_scans},
    {"5.11", "GF brings inputs and outputs before the time stamp", "urg_library 1.2.6",
     [](Subject& subject) { return brings_all(subject, "GF"); }},
    {"5.12", "GG brings inputs, outputs and intensities", "urg_library 1.2.6",
     [](Subject& subject) { return brings_all(subject, "GG"); }},
};

}  // namespace

std::span<const Check> single_scan_checks() {
    return table_of_single_scans;
}

}  // namespace scipd::tools::checks
