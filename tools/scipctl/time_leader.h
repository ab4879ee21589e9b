// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Leads the time of all daemons that share a world and work in lockstep: the stamps of pose lines
// are the time. It goes on when each of them has done the step before.
#pragma once

#include <istream>
#include <string>

#include "tools/scipctl/broker_session.h"

namespace scipd::tools {

/// Sends the lines of a text, one message for those of one stamp, until it ends. Lines that name
/// nothing are of `robot`. A daemon that acknowledges no step for so long is named and left out.
/// Throws ControlError if the broker cannot be reached or lines were refused.
void lead_time(const BrokerOptions& options, const std::string& robot, double patience_s,
               std::istream& lines);

}  // namespace scipd::tools
