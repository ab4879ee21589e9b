// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which buses this build can listen to. Any thread; nothing shared.
#pragma once

#include "sim/expected.h"

namespace scipd::daemon {

/// Refused with what is missing, and the package that it comes with.
sim::Expected<> check_gz_is_built();
sim::Expected<> check_ros2_is_built();

}  // namespace scipd::daemon
