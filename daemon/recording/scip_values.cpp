// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/recording/scip_values.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace scipd::daemon {
namespace {

using protocol::client::Message;
using protocol::client::Parameters;
using protocol::client::ScanMessage;
using protocol::client::Version;

sim::Entries entries_of(const Message& message) {
    sim::Entries entries;
    for (const std::string& line : message.lines) {
        const std::size_t colon = line.find(':');
        if (colon == line.npos) continue;
        entries.push_back({line.substr(0, colon), line.substr(colon + 1)});
    }
    return entries;
}

void take(const Version& version, sim::ScannerIdentity& identity) {
    identity.serial = version.serial;
    identity.firmware = version.firmware;
}

void take(const Parameters& parameters, sim::ScannerIdentity& identity) {
    // Some models append the maker's name.
    identity.model = parameters.model.substr(0, parameters.model.find('('));
    identity.min_range_m = parameters.dmin_mm / 1000.0;
    identity.max_range_m = parameters.dmax_mm / 1000.0;
    identity.steps_per_turn = parameters.ares;
    identity.front_step = parameters.afrt;
    identity.rpm = parameters.scan_rpm;
}

/// Puts what was read in its place; a sentence instead says that nothing was.
template <class Answer>
bool take_answer(const std::variant<Answer, std::string>& answer, sim::ScannerIdentity& identity) {
    const auto* const values = std::get_if<Answer>(&answer);
    if (values == nullptr) return false;
    take(*values, identity);
    return true;
}

void append_echoes(const ScanMessage& scan, std::size_t i, sim::RecordedScan& recorded) {
    const bool intensity = scan.request.intensity;
    recorded.ranges.push_back(scan.distances_mm[i]);
    if (intensity) recorded.intensities.push_back(scan.intensities[i]);
    if (!scan.request.echoes) return;
    for (const auto& echo : scan.further_echoes[i]) {
        recorded.ranges.push_back(echo.distance_mm);
        if (intensity) recorded.intensities.push_back(echo.intensity);
    }
    recorded.echo_ends.push_back(static_cast<std::uint32_t>(recorded.ranges.size()));
}

}  // namespace

bool learn_identity(const Message& message, sim::ScannerIdentity& identity) {
    if (message.damage) return false;
    const std::string_view code = std::string_view(message.echo).substr(0, 2);
    if (code == "VV") {
        if (!take_answer(parse_version(message), identity)) return false;
        identity.version = entries_of(message);
        return true;
    }
    if (message.echo == "V" && message.status == "0") {  // of SCIP 1.1
        identity.version = entries_of(message);
        identity.serial = value_of(identity.version, "SERI");
        identity.firmware = value_of(identity.version, "FIRM");
        return true;
    }
    if (code == "PP") {
        if (!take_answer(parse_parameters(message), identity)) return false;
        identity.parameters = entries_of(message);
        return true;
    }
    if (code != "II" || message.lines.empty()) return false;
    identity.state = entries_of(message);
    return true;
}

sim::ScannerIdentity identity_of(const Version& version, const Parameters& parameters) {
    sim::ScannerIdentity identity;
    take(version, identity);
    take(parameters, identity);
    return identity;
}

sim::RecordedScan recorded_scan(const ScanMessage& scan, const sim::ScannerIdentity& identity,
                                sim::HostTime received) {
    sim::RecordedScan recorded;
    recorded.host_time = received;
    if (scan.request.microseconds)
        recorded.stamp_us = scan.stamp_us;
    else
        recorded.stamp_ms = scan.stamp_ms;
    recorded.directions = with_angles(
        {.first_step = scan.request.first_step, .cluster = scan.request.cluster}, identity);
    for (std::size_t i = 0; i < scan.distances_mm.size(); ++i)
        append_echoes(scan, i, recorded);
    return recorded;
}

}  // namespace scipd::daemon
