// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include "daemon/models/model.h"

namespace scipd::daemon {

Model uxm_30lx_e();

}  // namespace scipd::daemon
