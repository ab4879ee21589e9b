// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/models/model_list.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/command_table.h"

namespace scipd::daemon {
namespace {

using Row = std::vector<std::string>;

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

Row figures_row(const Model& model) {
    const protocol::DeviceProfile& profile = model.profile;
    return {listed_name(model), links_of(profile),
            std::to_string(profile.dmin_mm) + "-" + std::to_string(profile.dmax_mm),
            std::to_string(profile.amin) + "-" + std::to_string(profile.amax) + " of " +
                std::to_string(profile.ares),
            rate_of(profile)};
}

std::string numbers_in(const std::set<std::uint32_t>& numbers) {
    std::string text;
    for (const std::uint32_t number : numbers)
        text.append(text.empty() ? "" : " ").append(std::to_string(number));
    return text;
}

/// Those of causes, and in brackets the others that come now and then.
std::string codes_of(const protocol::DeviceProfile& profile) {
    const protocol::DistanceCodes& codes = profile.codes;
    std::set<std::uint32_t> usual{codes.nothing, codes.too_near, codes.too_far, codes.not_measured};
    for (const auto& code :
         {codes.too_dark, codes.too_bright, codes.edge, codes.interference, codes.lost})
        usual.insert(code.value_or(codes.nothing));
    std::set<std::uint32_t> rare;
    for (const protocol::RareCode& code : profile.rare_codes) {
        if (!usual.contains(code.code)) rare.insert(code.code);
    }
    std::string text = numbers_in(usual);
    if (!rare.empty()) text.append(" (").append(numbers_in(rare)).append(")");
    return text;
}

std::string formatted(const char* pattern, double number) {
    char text[32];
    std::snprintf(text, sizeof text, pattern, number);
    return text;
}

double ms_of(protocol::Uptime time) {
    return std::chrono::duration<double, std::milli>(time).count();
}

/// When a scan leaves.
std::string pace_of(const protocol::DeviceProfile& profile) {
    if (profile.turns_per_reply == 1) return "every turn";
    if (profile.turns_per_reply > 1) return formatted("every %g turns", profile.turns_per_reply);
    const bool waits = profile.scan_delay > protocol::Uptime{};
    std::string text = waits ? formatted("after %.5g ms", ms_of(profile.scan_delay)) : "at once";
    if (profile.scan_tick > protocol::Uptime{})
        text += formatted(", tick %.5g ms", ms_of(profile.scan_tick));
    return text;
}

Row pace_row(const Model& model) {
    const protocol::DeviceProfile& profile = model.profile;
    return {listed_name(model), codes_of(profile), formatted("%.5g ms", ms_of(profile.scan_period)),
            pace_of(profile), formatted("%g s", ms_of(profile.boot_time) / 1000.0)};
}

Row commands_row(const Model& model) {
    return {listed_name(model), commands_of(model.profile)};
}

/// So that all columns fit a terminal.
std::string short_name_of(Evidence evidence) {
    const bool frequent = evidence == Evidence::documented || evidence == Evidence::deduced;
    return std::string(name_of(evidence).substr(0, frequent ? 3 : std::string::npos));
}

Row sureness_row(const Model& model) {
    const Sureness& sure = model.sureness;
    Row row{listed_name(model)};
    for (const Evidence evidence : {sure.links, sure.range, sure.steps, sure.rate, sure.commands,
                                    sure.texts, sure.noise, sure.bias, sure.light})
        row.push_back(short_name_of(evidence));
    return row;
}

Row pace_sureness_row(const Model& model) {
    const Sureness& sure = model.sureness;
    Row row{listed_name(model)};
    for (const Evidence evidence : {sure.codes, sure.turn, sure.pace, sure.boot})
        row.push_back(short_name_of(evidence));
    return row;
}

/// Columns as wide as their widest cell, two blanks apart.
std::string table(const std::vector<Row>& rows) {
    std::vector<std::size_t> widths(rows.front().size());
    for (const Row& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i)
            widths[i] = std::max(widths[i], row[i].size());
    }
    std::string text;
    for (const Row& row : rows) {
        for (std::size_t i = 0; i + 1 < row.size(); ++i)
            text += row[i] + std::string(widths[i] - row[i].size() + 2, ' ');
        text += row.back() + "\n";
    }
    return text;
}

std::string table_of(Row titles, std::span<const Model> models, Row (*row_of)(const Model&)) {
    std::vector<Row> rows{std::move(titles)};
    for (const Model& model : models)
        rows.push_back(row_of(model));
    return table(rows);
}

}  // namespace

std::string listed_name(const Model& model) {
    return model.profile.name + "@" + model.profile.release;
}

std::string links_of(const protocol::DeviceProfile& profile) {
    if (protocol::is_ethernet(profile.family)) return "Ethernet";
    return profile.bit_rates.empty() ? "USB" : "USB, RS-232";
}

std::string list_of(std::span<const Model> models) {
    return table_of({"MODEL", "LINKS", "RANGE mm", "STEPS", "SCANS"}, models, figures_row) + "\n" +
           table_of({"MODEL", "COMMANDS"}, models, commands_row) + "\n" +
           table_of({"MODEL", "CODES", "TURN", "SCAN LEAVES", "BOOT"}, models, pace_row) +
           "\nHow each figure is known: seen on the wire of a real unit; measured from recordings "
           "of "
           "this\nproduct; doc, by its maker or by a driver whose author had a unit; deduced from "
           "similar models;\nassumed to be as with the nearest relative, or of a usual size.\n\n" +
           table_of({"MODEL", "LINKS", "RANGE", "STEPS", "SCANS", "COMMANDS", "TEXTS", "NOISE",
                     "BIAS", "LIGHT"},
                    models, sureness_row) +
           "\n" +
           table_of({"MODEL", "CODES", "TURN", "SCAN LEAVES", "BOOT"}, models, pace_sureness_row);
}

}  // namespace scipd::daemon
