// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What writes a setting, stops the motor or reboots: only with --unsafe. Each check puts back what
// it changes.
#include <string>
#include <thread>

#include "protocol/client/error.h"
#include "tools/scipcat/check/check_table.h"

namespace scipd::tools::checks {
namespace {

using std::chrono::milliseconds;

constexpr std::string_view spec_settings = "SCIP 2.0 (C-42-03320B) p. 16 to 19";
constexpr std::string_view spec_reboot = "C-42-04076 p. 13; urg_stamped";

/// Whether the command is there, by what it answers without parameters or to a wrong one.
bool lacks(Subject& subject, const std::string& request) {
    const std::string status = subject.ask(request).status();
    return status == "0E" || status == "0F" || status == "0C";
}

bool on_ethernet_line(const Subject& subject) {
    return subject.facts().line == Line::ethernet_multi_echo || subject.facts().line == Line::ust;
}

Finding partial_reset(Subject& subject) {
    if (!on_ethernet_line(subject)) return not_applicable("RT is known of Ethernet models alone");
    subject.rest();
    subject.stream("MD" + subject.window() + "01000");
    (void)subject.scans(1);
    if (auto fine = subject.expect("RT", "00"); !fine.passed()) return fine;
    return subject.expect_laser_off();
}

Finding present_rate(Subject& subject) {
    const std::string text = subject.facts().text("SBPS");
    const std::string digits = text.substr(0, text.find_first_not_of("0123456789"));
    if (digits.empty() || digits.size() > 6) return not_applicable("II names no rate");
    subject.rest();
    return subject.expect("SS" + std::string(6 - digits.size(), '0') + digits, "03");
}

Finding other_rate(Subject& subject) {
    if (subject.facts().text("SBPS").find("[bps]") == std::string::npos)
        return not_applicable("II names no rate");
    subject.rest();
    return subject.expect("SS000001", "02");
}

Finding motor_speed(Subject& subject) {
    subject.rest();
    if (lacks(subject, "CR50") || subject.ask("CR50").status() == "04")
        return not_applicable("its motor has one speed");
    (void)subject.ask("CR00");
    for (const auto& [request, status] : {std::pair{"CR02", "00"}, {"CR02", "03"}}) {
        if (auto fine = subject.expect(request, status); !fine.passed()) return fine;
    }
    subject.stream("MD" + subject.window() + "01004");
    const auto scans = subject.scans(4);
    const double period = since(scans.front().stamp_ms, scans.back().stamp_ms) / 3.0;
    subject.rest();
    if (auto fine = subject.expect("CR00", "00"); !fine.passed()) return fine;
    return require(period > subject.facts().period_ms() * 1.005,
                   "with CR02 the mirror turns no slower");
}

Finding sensitivity(Subject& subject) {
    subject.rest();
    if (lacks(subject, "HS2") || subject.ask("HS2").status() == "03")
        return not_applicable("it has one sensitivity");
    (void)subject.ask("HS0");
    for (const auto& [request, status] :
         {std::pair{"HS1", "00"}, {"HS1", "02"}, {"HS0", "00"}, {"HS0", "02"}}) {
        if (auto fine = subject.expect(request, status); !fine.passed()) return fine;
    }
    return pass();
}

Finding rehearsal(Subject& subject) {
    subject.rest();
    if (lacks(subject, "DB99") || subject.ask("DB99").status() == "04")
        return not_applicable("it does not rehearse");
    return subject.expect("DB10", "03");
}

bool stands_by(Subject& subject) {
    return subject.ask("%ST").message.lines == std::vector<std::string>{"000"};
}

Finding sleeps(Subject& subject) {
    if (!subject.facts().knows("%ST")) return not_applicable("it does not sleep");
    subject.rest();
    if (auto fine = subject.expect("%SL", "00"); !fine.passed()) return fine;
    const Answer asleep = subject.ask("%ST");
    if (asleep.message.lines != std::vector<std::string>{"005"})
        return fail("%ST does not say 005 after %SL");
    constexpr int tries = 40;
    for (int i = 0; i < tries; ++i) {
        subject.rest();
        if (stands_by(subject)) return pass();
        std::this_thread::sleep_for(milliseconds(200));
    }
    return fail("QT does not wake it up");
}

Finding asked_once(Subject& subject) {
    if (!on_ethernet_line(subject)) return not_applicable("RB is known of Ethernet models alone");
    subject.rest();
    for (int i = 0; i < 2; ++i) {
        if (auto fine = subject.expect("RB", "01"); !fine.passed()) return fine;
        std::this_thread::sleep_for(milliseconds(1200));
    }
    return require(subject.ask("QT").status() == "00", "a single RB does more than nothing");
}

/// Waits until the scanner is up again. False: it is not within this time. Some answer meanwhile.
bool comes_back(Subject& subject, milliseconds within) {
    for (const auto end = Clock::now() + within; Clock::now() < end;) {
        try {
            subject.wire().reconnect();
            if (stands_by(subject)) return true;
        } catch (const protocol::client::Error&) {  // not yet
        }
        std::this_thread::sleep_for(milliseconds(200));
    }
    return false;
}

Finding reboots(Subject& subject) {
    if (!on_ethernet_line(subject)) return not_applicable("RB is known of Ethernet models alone");
    subject.rest();
    for (const char* const status : {"01", "00"}) {
        if (auto fine = subject.expect("RB", status); !fine.passed()) return fine;
    }
    if (!subject.wire().ends_within(milliseconds(2500)))
        return fail("the connection does not end after the second RB");
    return require(comes_back(subject, milliseconds(15'000)), "it does not come back within 15 s");
}

constexpr Check table_of_unsafe[] = {
    {"14.1", "RT ends a stream and switches the laser off", "C-42-04076; hokuyolx", partial_reset},
    {"14.2", "SS of the present rate is refused with 03", spec_settings, present_rate},
    {"14.3", "SS of a rate that there is not is refused with 02", spec_settings, other_rate},
    {"14.4", "CR slows the motor down, and is refused with 03 the second time", spec_settings,
     motor_speed},
    {"14.5", "HS sets the sensitivity, and is refused with 02 the second time", spec_settings,
     sensitivity},
    {"14.6", "DB10 without a rehearsal is refused with 03", spec_settings, rehearsal},
    {"14.7", "%SL puts it to sleep, and QT wakes it up", "hokuyolx, urg_library", sleeps},
    {"14.8", "RB once is answered with 01 and does nothing", spec_reboot, asked_once},
    {"14.9", "RB twice reboots: the connection ends, and it comes back within 15 s", spec_reboot,
     reboots},
};

}  // namespace

std::span<const Check> unsafe_checks() {
    return table_of_unsafe;
}

}  // namespace scipd::tools::checks
