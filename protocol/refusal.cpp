// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/refusal.h"

#include "protocol/command_table.h"

namespace scipd::protocol {
namespace {

std::optional<Status> refusal_by_length(const Request& request) {
    const std::size_t expected = width(request.command->parameters);
    if (request.parameters_length < expected) return status::too_short;
    if (request.parameters_length > expected) return status::too_long;
    return std::nullopt;
}

}  // namespace

// The state goes before the parameters: a bare GD with the laser off is 10 on a UST-10LX, not 0C.
std::optional<Status> refusal_of(const Request& request, State state, Trouble trouble,
                                 LinkKind link, const DeviceProfile& profile) {
    if (request.fault) return request.fault;
    if (request.command == nullptr) return profile.unknown_command;
    const Command& command = *request.command;
    const bool laser_fails = trouble == Trouble::unstable || trouble == Trouble::laser;
    if (command.code == "BM" && is_ethernet(profile.family) && laser_fails) return status::no_laser;
    const auto status = refusal(command, state, profile);
    // Real models for Ethernet have no tty. Ours have one, and there SS gets the answer of a tty
    // that has no rate to set, with which drivers for serial lines go on. Deduced.
    if (command.code == "SS" && link == LinkKind::tty && status == status::unsupported)
        return status::setting::fixed;
    return status ? status : refusal_by_length(request);
}

}  // namespace scipd::protocol
