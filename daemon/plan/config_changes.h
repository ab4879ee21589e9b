// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a configuration changes in the place of another one, in words for the log. Any thread.
#pragma once

#include <string>

#include "daemon/config/config.h"

namespace scipd::daemon {

/// "new: r/top; gone: r/front; changed: r/rear, seed", or "nothing changed".
[[nodiscard]] std::string changes_between(const Config& was, const Config& is);

}  // namespace scipd::daemon
