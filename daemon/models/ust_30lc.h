// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string>

#include "daemon/models/model.h"

namespace scipd::daemon {

/// With firmware 1.0.1, 4.0.2-A, 4.0.3 or 4.1.0b-A.
Model ust_30lc(const std::string& firmware);

}  // namespace scipd::daemon
