// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What was fitted, as a configuration that scipd runs. Each value says where it is from. One
// thread.
#pragma once

#include <iosfwd>
#include <string>

#include "tools/scipfit/fit.h"

namespace scipd::tools {

/// `scene`: the room that was made of the same recording, as the configuration names it; empty:
/// scipd's own world.
void write_profile(const Fit& fit, const std::string& scene, std::ostream& out);

}  // namespace scipd::tools
