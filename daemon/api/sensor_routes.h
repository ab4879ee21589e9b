// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How the daemon and its sensors are doing, what those say that speak no SCIP, and what was true
// when they measured.
#pragma once

#include "daemon/api/routes.h"

namespace scipd::daemon {

void get_status(Call&& call);
void get_sensors(Call&& call);
void get_sensor(Call&& call);
void get_reading(Call&& call);
void get_truth(Call&& call);

}  // namespace scipd::daemon
