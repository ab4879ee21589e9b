// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/models/model.h"

#include <cstdio>
#include <utility>

#include "protocol/command_table.h"

namespace scipd::daemon {
namespace {

std::string links_of(const protocol::DeviceProfile& profile) {
    using protocol::Family;
    if (profile.family == Family::b || profile.family == Family::c) return "Ethernet";
    return profile.bit_rates.empty() ? "USB" : "USB, RS-232";
}

std::string commands_of(const protocol::DeviceProfile& profile) {
    std::string text;
    for (const protocol::Command& command : protocol::command_table()) {
        if (!command.gate(profile.family).known() || !profile.has(command.needs)) continue;
        if (!text.empty()) text += ' ';
        text += command.code;
    }
    return text;
}

// 40, 14.9
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

Model make_model(const protocol::DeviceProfile& profile, std::vector<sim::NoiseStep> noise,
                 Sureness sureness) {
    constexpr double m_per_mm = 1e-3;
    return {.profile = profile,
            .optics = {.steps_per_turn = profile.ares,
                       .first_step = profile.amin,
                       .last_step = profile.amax,
                       .front_step = profile.afrt,
                       .scan_period = profile.scan_period,
                       .max_range_m = profile.dmax_mm * m_per_mm,
                       .noise = std::move(noise)},
            .sureness = sureness};
}

std::string describe(const Model& model) {
    const auto& profile = model.profile;
    const auto said = [](Evidence evidence) { return std::string(name_of(evidence)); };
    return profile.name + "@" + profile.release + "  " + std::to_string(profile.dmin_mm) + "-" +
           std::to_string(profile.dmax_mm) + " mm, steps " + std::to_string(profile.amin) + "-" +
           std::to_string(profile.amax) + " of " + std::to_string(profile.ares) + ", " +
           rate_of(profile) + "; " + links_of(profile) + "; " + commands_of(profile) +
           (profile.speaks_scip1() ? "; SCIP 1.1" : "") + "; texts " + said(model.sureness.texts) +
           ", steps " + said(model.sureness.steps) + ", noise " + said(model.sureness.noise);
}

}  // namespace scipd::daemon
