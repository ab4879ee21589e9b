// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <nlohmann/json.hpp>

#include "tools/scipfit/fit.h"

namespace scipd::tools {

/// What is not known is null, and named in "unknown".
[[nodiscard]] nlohmann::ordered_json as_json(const Fit& fit);

}  // namespace scipd::tools
