// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The body of a request for one sensor more. Only what a client of the API may say is seen here;
// the values are read as those of a configuration are. Any thread; nothing shared.
#pragma once

#include <string>

#include "daemon/config/added_sensor.h"
#include "sim/expected.h"

namespace scipd::daemon {

/// Faults name the member.
sim::Expected<AddedSensor> parse_new_sensor(const std::string& body);

/// Whether it names a file of this machine, which nobody may do over the API; the fault says so.
sim::Expected<> check_files(const AddedSensor& sensor);

}  // namespace scipd::daemon
