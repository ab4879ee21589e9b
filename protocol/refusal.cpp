// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/refusal.h"

namespace scipd::protocol {
namespace {

bool is_ethernet(const DeviceProfile& profile) {
    return profile.family == Family::b || profile.family == Family::c;
}

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
    if (command.operation == Operation::switch_laser_on && is_ethernet(profile) && no_laser)
        return Status("01");
    if (const auto status = refusal(command, state, profile)) return status;
    // Asked by network, the rate of a serial line is none of this model's; on the tty that it has
    // here it is 04 (settings), with which drivers for serial lines go on. Deduced.
    if (command.operation == Operation::set_bit_rate && is_ethernet(profile) &&
        link == LinkKind::network)
        return status::unsupported;
    return refusal_by_length(request);
}

}  // namespace scipd::protocol
