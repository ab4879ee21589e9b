// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Whether two worlds are the same: a number of all that casts, moves or has a name in them. Any
// thread.
#pragma once

#include <string>

#include "sim/world/scene.h"

namespace scipd::daemon {

/// 16 hexadecimal digits. Lengths count in micrometres, so that two machines that round differently
/// agree.
std::string content_hash(const sim::Scene& scene);

}  // namespace scipd::daemon
