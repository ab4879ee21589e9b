// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The bodies of requests for a new sensor and for the reading errors of a scanner, and those
// errors as the status shows them. The values are read as those of a configuration are. Any
// thread; nothing shared.
#pragma once

#include <string>

#include "daemon/api/documents.h"
#include "daemon/config/added_sensor.h"
#include "daemon/config/reading_errors.h"
#include "sim/expected.h"

namespace scipd::daemon {

/// `now` with the members of the body that differ. A fault names the member.
[[nodiscard]] sim::Expected<ReadingErrors> parse_errors(const std::string& body,
                                                        const ReadingErrors& now);

[[nodiscard]] Json errors_document(const ReadingErrors& errors);

/// Faults name the member.
sim::Expected<AddedSensor> parse_new_sensor(const std::string& body);

/// Refuses a sensor that names a file of this machine, which nobody may do over the API.
sim::Expected<> check_files(const AddedSensor& sensor);

}  // namespace scipd::daemon
