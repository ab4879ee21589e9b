// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What each command does: one function for each kind of command, which rows of the command table
// name.
#pragma once

#include "protocol/acquisition.h"
#include "protocol/command.h"
#include "protocol/device_profile.h"
#include "protocol/device_state.h"
#include "protocol/request.h"
#include "protocol/uptime.h"

namespace scipd::protocol {

/// A request that is carried out, and all that its handler may look at and change.
struct Call {
    const Request& request;
    Uptime arrived;  ///< when the request came in
    Uptime now;      ///< when its reply leaves
    const DeviceProfile& profile;
    DeviceState& device;
    Acquisition& acquisition;  ///< of the client who asks
};

namespace handlers {

Response report_version(const Call& call);
Response report_parameters(const Call& call);
Response report_state(const Call& call);
Response report_state_number(const Call& call);
Response report_time(const Call& call);

Response switch_laser_on(const Call& call);
Response quit(const Call& call);
/// Refused while another client streams.
Response sleep(const Call& call);
Response reset(const Call& call);
Response partial_reset(const Call& call);
Response reboot(const Call& call);

Response begin_single_scan(const Call& call);
Response begin_stream(const Call& call);

Response enter_adjust(const Call& call);
Response leave_adjust(const Call& call);
/// TM with anything but 0, 1 and 2.
Response refuse_digit(const Call& call);

Response set_bit_rate(const Call& call);
Response set_motor_level(const Call& call);
Response set_sensitivity(const Call& call);
Response set_address(const Call& call);
Response rehearse(const Call& call);
/// SCIP2.0, which is spoken already.
Response choose_scip2(const Call& call);

}  // namespace handlers
}  // namespace scipd::protocol
