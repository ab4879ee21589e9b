// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What this machine's EGL offers the depth backend. depth_device.cpp looks at the machine; in a
// build that cannot draw, no_depth.cpp says so. One thread: the one that is to draw.
#pragma once

#include "sim/backends/backend_row.h"

namespace scipd::sim {

/// Describes every place of EGL, whether a test picture comes out right there, and which is used.
BackendProbe probe_depth();

}  // namespace scipd::sim
