// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a rig has counted, as Prometheus reads it. docs/operations.md has a table of it. Any
// thread.
#pragma once

#include <string>

#include "daemon/api/rig_report.h"

namespace scipd::daemon {

[[nodiscard]] std::string metrics_text(const RigReport& rig);

}  // namespace scipd::daemon
