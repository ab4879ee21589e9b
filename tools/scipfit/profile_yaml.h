// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What was fitted, as a configuration that scipd runs. Each value says where it is from. One
// thread.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>

#include "tools/scipfit/fit.h"

namespace scipd::tools {

/// What the scanner of a profile looks at.
struct Surroundings {
    std::string scene = {};  ///< as the configuration names it; empty: scipd's own world
    /// Where the scanner stands in a world; nothing: the scene is a room that was made of the same
    /// recording.
    std::optional<FlatPose> place = std::nullopt;
};

void write_profile(const Fit& fit, const Surroundings& surroundings, std::ostream& out);

}  // namespace scipd::tools
