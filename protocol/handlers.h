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
struct RequestContext {
    const Request& request;
    Uptime arrived;  ///< when the request came in
    Uptime now;      ///< when its reply leaves
    const DeviceProfile& profile;
    DeviceState& device;
    Acquisition& acquisition;  ///< of the client who asks
};

namespace handlers {

Response report_version(const RequestContext& context);
Response report_parameters(const RequestContext& context);
Response report_state(const RequestContext& context);
Response report_state_number(const RequestContext& context);
Response report_time(const RequestContext& context);

Response switch_laser_on(const RequestContext& context);
Response quit(const RequestContext& context);
/// Refused while another client streams.
Response sleep(const RequestContext& context);
Response reset(const RequestContext& context);
Response partial_reset(const RequestContext& context);
Response reboot(const RequestContext& context);

Response begin_single_scan(const RequestContext& context);
Response begin_stream(const RequestContext& context);

Response enter_adjust(const RequestContext& context);
Response leave_adjust(const RequestContext& context);
/// TM with anything but 0, 1 and 2.
Response refuse_digit(const RequestContext& context);

Response set_bit_rate(const RequestContext& context);
Response set_motor_level(const RequestContext& context);
Response set_sensitivity(const RequestContext& context);
Response set_address(const RequestContext& context);
Response rehearse(const RequestContext& context);
/// SCIP2.0, which is spoken already.
Response choose_scip2(const RequestContext& context);

}  // namespace handlers
}  // namespace scipd::protocol
