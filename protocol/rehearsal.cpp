// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/rehearsal.h"

#include "protocol/step_window.h"

namespace scipd::protocol {
namespace {

// The numbers of SCIP 2.0 specification C-42-03320B.
enum : int {
    nothing = 0,
    malfunction_in_scip1 = 1,
    malfunction = 2,
    passing_error = 3,  ///< normal, error, normal
    lasting_error = 4,  ///< normal, error, malfunction
    sudden_malfunction = 5,
    the_end = 10,
};

// The specification says that a stream must have more than 20 scans. It does not say when in the
// stream the trouble begins and ends.
constexpr int shortest_stream = 21;
constexpr int normal_scans = 10;
constexpr int error_turns = 5;

bool named(int number) {
    return (number >= malfunction_in_scip1 && number <= sudden_malfunction) || number == the_end;
}

}  // namespace

Status rehearse(DeviceState& device, std::string_view digits, const DeviceProfile& profile) {
    if (profile.rehearsals == Support::never) return status::rehearsal::not_on_this_model;
    if (profile.rehearsals == Support::later_firmware) return status::too_short;
    const auto number = parse_digits(digits);
    if (!number || !named(*number)) return status::rehearsal::unknown;
    const int under_way = device.rehearsal();
    if (under_way == nothing && device.trouble() != Trouble::none)
        return status::rehearsal::in_real_trouble;
    if (*number == under_way) return status::rehearsal::under_way;
    if (*number == the_end && under_way == nothing) return status::rehearsal::nothing_to_end;
    if (*number == malfunction_in_scip1 && !profile.speaks_scip1())
        return status::rehearsal::not_on_this_model;
    const bool at_once = *number == malfunction_in_scip1 || *number == malfunction;
    device.set_trouble(at_once ? Trouble::abnormal : Trouble::none);
    if (*number == malfunction_in_scip1) device.speak_scip1();
    device.set_rehearsal(*number == the_end ? nothing : *number);
    return status::ok;
}

void rehearse_in_stream(DeviceState& device, const Subscription& stream) {
    const int number = device.rehearsal();
    if (number < passing_error || !stream.has_at_least(shortest_stream)) return;
    if (stream.sent() < normal_scans) return;
    if (number == sudden_malfunction) return device.set_trouble(Trouble::abnormal);
    if (stream.sent() > normal_scans) return;  // the error has passed
    if (stream.interruptions() < error_turns) return device.set_trouble(Trouble::unstable);
    device.set_trouble(number == lasting_error ? Trouble::abnormal : Trouble::none);
}

}  // namespace scipd::protocol
