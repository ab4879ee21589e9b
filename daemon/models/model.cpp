// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/models/model.h"

#include <cstdio>
#include <utility>

#include "protocol/command_table.h"

namespace scipd::daemon {
namespace {

std::string links_of(const protocol::DeviceProfile& profile) {
    if (protocol::is_ethernet(profile.family)) return "Ethernet";
    return profile.bit_rates.empty() ? "USB" : "USB, RS-232";
}

/// A command that the model only refuses does not count.
bool carries_out(const protocol::DeviceProfile& profile, const protocol::Command& command) {
    if (!command.gate(profile.family).known() || !profile.has(command.needs)) return false;
    if (command.code == "SS") return !profile.bit_rates.empty();
    if (command.code == "CR") return profile.motor_levels;
    if (command.code == "HS") return profile.sensitivity == protocol::Support::yes;
    if (command.code == "DB") return profile.rehearsals == protocol::Support::yes;
    if (command.code == "SCIP2.0") return profile.speaks_scip1();
    return !command.code.ends_with("TM");
}

std::string commands_of(const protocol::DeviceProfile& profile) {
    std::string text;
    for (const protocol::Command& command : protocol::command_table()) {
        if (!carries_out(profile, command)) continue;
        if (!text.empty()) text += ' ';
        text += command.code;
    }
    return text + (profile.speaks_scip1() ? ", SCIP 1.1" : "");
}

// Prints 40 or 14.9.
std::string rate_of(const protocol::DeviceProfile& profile) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g Hz",
                  1.0 / std::chrono::duration<double>(profile.nominal_scan_period()).count());
    return text;
}

}  // namespace

std::string_view name_of(Evidence evidence) {
    switch (evidence) {
        case Evidence::seen:
            return "seen";
        case Evidence::documented:
            return "documented";
        case Evidence::deduced:
            return "deduced";
    }
    return "";
}

Model make_model(const protocol::DeviceProfile& profile, sim::SensorSpec optics,
                 Sureness sureness) {
    constexpr double m_per_mm = 1e-3;
    optics.steps_per_turn = profile.ares;
    optics.first_step = profile.amin;
    optics.last_step = profile.amax;
    optics.front_step = profile.afrt;
    optics.scan_period = profile.scan_period;
    optics.max_range_m = profile.dmax_mm * m_per_mm;
    return {.profile = profile, .optics = std::move(optics), .sureness = sureness};
}

std::string describe(const Model& model) {
    const auto& [profile, optics, sure] = model;
    const auto said = [](Evidence evidence) { return std::string(name_of(evidence)); };
    const auto figure = [&](const std::string& text, Evidence evidence) {
        return text + " (" + said(evidence) + ")";
    };
    const std::string range =
        std::to_string(profile.dmin_mm) + "-" + std::to_string(profile.dmax_mm) + " mm";
    const std::string steps = "steps " + std::to_string(profile.amin) + "-" +
                              std::to_string(profile.amax) + " of " + std::to_string(profile.ares);
    return profile.name + "@" + profile.release + "  " + figure(range, sure.range) + ", " +
           figure(steps, sure.steps) + ", " + figure(rate_of(profile), sure.rate) + "; " +
           figure(links_of(profile), sure.links) + "; " +
           figure(commands_of(profile), sure.commands) + "; texts " + said(sure.texts) +
           ", noise " + said(sure.noise) + ", bias " + said(sure.bias) + ", light " +
           said(sure.light);
}

}  // namespace scipd::daemon
