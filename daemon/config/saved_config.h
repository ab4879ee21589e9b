// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A configuration as a text that can be read again, wherever it is put: what its own file said,
// with what the configuration says now in the place of that. Paths are absolute and mounts are
// numbers. Left out is who may come in from where (control, allow) and the world that is shared
// (fleet). Any thread; nothing shared.
#pragma once

#include <string>

#include "daemon/config/config.h"

namespace scipd::daemon {

/// The world is in the file `scene`, relative to the text.
std::string saved_config(const Config& config, const std::string& scene);

}  // namespace scipd::daemon
