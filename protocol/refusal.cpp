// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/refusal.h"

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
    const bool no_laser = trouble == Trouble::unstable || trouble == Trouble::laser;
    if (command.operation == Operation::switch_laser_on && is_ethernet(profile.family) && no_laser)
        return Status("01");
    const auto status = refusal(command, state, profile);
    // Models for Ethernet have no tty; on the one that they have here SS is what it is on a tty
    // without a bit rate to set, with which drivers for serial lines go on. Deduced.
    if (command.operation == Operation::set_bit_rate && link == LinkKind::tty &&
        status == status::unsupported)
        return Status("04");
    return status ? status : refusal_by_length(request);
}

}  // namespace scipd::protocol
