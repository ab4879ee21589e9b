// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include "daemon/models/model.h"

namespace scipd::daemon {

Model utm_30lx_ew();

}  // namespace scipd::daemon
