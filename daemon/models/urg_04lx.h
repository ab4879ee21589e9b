// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include "daemon/models/model.h"

namespace scipd::daemon {

Model urg_04lx();

}  // namespace scipd::daemon
