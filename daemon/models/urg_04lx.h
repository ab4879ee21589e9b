// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include "daemon/models/model.h"

namespace scipd::daemon {

Model urg_04lx_3_1_04();
Model urg_04lx_3_3_00();

}  // namespace scipd::daemon
