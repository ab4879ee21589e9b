// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <iosfwd>

#include "tools/scipfit/fit.h"

namespace scipd::tools {

/// For people: what is known, with intervals of 95 %, and what is not.
void show(const Fit& fit, std::ostream& out);

}  // namespace scipd::tools
