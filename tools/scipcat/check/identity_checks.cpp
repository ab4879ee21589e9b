// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// VV, PP and II: what a scanner says of itself.
#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include "protocol/char_code.h"
#include "tools/scipcat/check/check_table.h"

namespace scipd::tools::checks {
namespace {

constexpr std::string_view spec_questions = "SCIP 2.0 (C-42-03320B), VV PP II";

Finding has_keys(Subject& subject, const std::string& request,
                 const std::vector<std::string>& keys) {
    subject.rest();
    const auto lines = subject.ask(request).lines();
    if (lines.size() != keys.size() + 2)
        return fail(request + " is answered with " + std::to_string(lines.size()) + " lines, not " +
                    std::to_string(keys.size() + 2));
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (!lines[i + 2].starts_with(keys[i] + ":"))
            return fail("line " + std::to_string(i + 3) + " is not " + keys[i]);
    }
    return pass();
}

/// One text of a fresh answer.
std::string ask_text(Subject& subject, const std::string& request, const std::string& key) {
    Facts facts;
    take_texts(facts, subject.ask(request).raw);
    return facts.text(key);
}

Finding state_lines(Subject& subject) {
    subject.rest();
    if (subject.ask("II").lines().size() == 4) return has_keys(subject, "II", {"MODL", "STAT"});
    return has_keys(subject, "II", {"MODL", "LASR", "SCSP", "MESM", "SBPS", "TIME", "STAT"});
}

Finding sound_figures(Subject& subject) {
    subject.rest();
    Facts facts;
    take_texts(facts, subject.ask("PP").raw);
    std::vector<int> values;
    for (const char* const key : {"DMIN", "DMAX", "ARES", "AMIN", "AMAX", "AFRT", "SCAN"}) {
        const std::string text = facts.text(key);
        if (text.empty() || text.size() > 9 ||
            !std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0; }))
            return fail(std::string(key) + " is \"" + text + "\", which is no number");
        values.push_back(std::stoi(text));
    }
    if (values[0] >= values[1]) return fail("DMIN is not less than DMAX");
    if (values[3] > values[5] || values[5] > values[4]) return fail("AFRT is not in AMIN to AMAX");
    return require(values[4] < values[2] && values[6] > 0,
                   "AMAX is not less than ARES, or SCAN is 0");
}

Finding one_model(Subject& subject) {
    subject.rest();
    const std::string in_parameters = ask_text(subject, "PP", "MODL");
    const std::string in_state = ask_text(subject, "II", "MODL");
    return require(in_parameters == in_state, "PP says " + in_parameters + ", II says " + in_state);
}

Finding laser_text(Subject& subject) {
    subject.rest();
    const std::string off = ask_text(subject, "II", "LASR");
    subject.measure();
    const std::string on = ask_text(subject, "II", "LASR");
    if (off != "OFF") return fail("after QT it says LASR:" + off);
    return require(on == "ON", "after BM it says LASR:" + on);
}

Finding spelled_time(Subject& subject) {
    subject.rest();
    const std::string time = ask_text(subject, "II", "TIME");
    const bool hexadecimal =
        time.size() == 6 && time.find_first_not_of("0123456789ABCDEF") == std::string::npos;
    const bool encoded = time.size() == 4 && protocol::decode(time).has_value();
    return require(hexadecimal || encoded, "TIME is \"" + time + "\"");
}

// They compare the beginning.
Finding healthy_text(Subject& subject) {
    subject.rest();
    const std::string health = ask_text(subject, "II", "STAT");
    const std::vector<std::string> fine = {"Stable 000 no error", "Sensor works well",
                                           "sensor is working normally", "failed to synchronize",
                                           "detected multiple master sensor"};
    return require(std::ranges::any_of(
                       fine, [&](const std::string& text) { return health.starts_with(text); }),
                   "STAT is \"" + health + "\", which drivers take for trouble");
}

Finding protocol_text(Subject& subject) {
    subject.rest();
    const std::string protocol = ask_text(subject, "VV", "PROT");
    return require(protocol.starts_with("SCIP 2."), "PROT is \"" + protocol + "\"");
}

Finding serial_text(Subject& subject) {
    subject.rest();
    const std::string serial = ask_text(subject, "VV", "SERI");
    const bool plain = std::ranges::all_of(
        serial, [](unsigned char c) { return std::isalnum(c) != 0 || c == '-'; });
    return require(!serial.empty() && plain, "SERI is \"" + serial + "\"");
}

Finding short_lines(Subject& subject) {
    subject.rest();
    constexpr std::size_t most = 71;
    for (const char* const request : {"VV", "PP", "II"}) {
        for (const std::string& line : subject.ask(request).lines()) {
            if (line.size() > most)
                return fail("a line of " + std::string(request) + " has " +
                            std::to_string(line.size()) + " characters");
        }
    }
    return pass();
}

Finding same_words(Subject& subject) {
    subject.rest();
    for (const char* const request : {"VV", "PP"}) {
        if (subject.ask(request).raw != subject.ask(request).raw)
            return fail(std::string(request) + " is not answered twice with the same");
    }
    return pass();
}

Finding firmware_text(Subject& subject) {
    subject.rest();
    const std::string firmware = ask_text(subject, "VV", "FIRM");
    return require(!firmware.substr(0, firmware.find_first_of(" (")).empty(),
                   "FIRM is \"" + firmware + "\"");
}

Finding mode_text(Subject& subject) {
    subject.rest();
    std::string mode = ask_text(subject, "II", "MESM");
    std::ranges::transform(mode, mode.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return require(
        mode.find("idle") != std::string::npos || mode.find("measuring") != std::string::npos,
        "with the laser off MESM is \"" + mode + "\"");
}

/// A command without its parameters is refused for its length or for the state where it is known.
Finding core_commands(Subject& subject) {
    subject.rest();
    for (const char* const request : {"VV", "PP", "II", "TM2", "BM", "GD", "MD"})
        (void)subject.try_ask(request);
    std::string unknown;
    for (const std::string& command : subject.lacking())
        unknown += (unknown.empty() ? "" : ", ") + command;
    return require(unknown.empty(), "it does not know " + unknown);
}

constexpr Check table_of_identity[] = {
    {"2.0", "it knows VV, PP, II, TM, BM, GD and MD",
     "SCIP 2.0 (C-42-03320B) p. 10 to 15, VV PP II", core_commands},
    {"2.1", "VV has the lines VEND, PROD, FIRM, PROT and SERI", spec_questions,
     [](Subject& subject) {
         return has_keys(subject, "VV", {"VEND", "PROD", "FIRM", "PROT", "SERI"});
     }},
    {"2.2", "PP has the lines MODL, DMIN, DMAX, ARES, AMIN, AMAX, AFRT and SCAN, and no ninth",
     "recorded URG, UTM, UXM and UST; UrgBenri refuses the ninth of C-42-04076",
     [](Subject& subject) {
         return has_keys(subject, "PP",
                         {"MODL", "DMIN", "DMAX", "ARES", "AMIN", "AMAX", "AFRT", "SCAN"});
     }},
    {"2.3", "II has the lines MODL, LASR, SCSP, MESM, SBPS, TIME and STAT", spec_questions,
     state_lines},
    {"2.4", "the figures of PP are numbers that fit together", spec_questions, sound_figures},
    {"2.5", "II names the model that PP names", spec_questions, one_model},
    {"2.6", "II tells whether the laser is on", spec_questions, laser_text},
    {"2.7", "TIME has six hexadecimal digits or four characters of SCIP",
     "recorded URG-04LX and UST-10LX", spelled_time},
    {"2.8", "STAT says good health in words that drivers know", "urg_library, urg_node",
     healthy_text},
    {"2.9", "PROT says SCIP 2", spec_questions, protocol_text},
    {"2.10", "SERI has letters and digits", "recorded units; hokuyo_node", serial_text},
    {"2.11", "no line of VV, PP and II is longer than 71 characters",
     "urg_library, which reads lines into 72 bytes", short_lines},
    {"2.12", "VV and PP are answered with the same words each time", spec_questions, same_words},
    {"2.13", "FIRM names a version before a blank or a bracket", "urg_library", firmware_text},
    {"2.14", "MESM says idle or measuring while the laser is off", "urg_stamped", mode_text},
};

}  // namespace

std::span<const Check> identity_checks() {
    return table_of_identity;
}

}  // namespace scipd::tools::checks
