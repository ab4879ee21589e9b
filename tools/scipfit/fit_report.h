// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A fit as people and programs read it: text, JSON, a page, and the profile for scipd. Any thread;
// nothing shared.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "tools/scipfit/fit.h"
#include "tools/scipfit/room_fit.h"

namespace scipd::tools {

/// For people: what is known, with intervals of 95 %, and what is not.
void show(const Fit& fit, std::ostream& out);
/// Figures that are not known are null, and named in "unknown".
[[nodiscard]] nlohmann::ordered_json as_json(const Fit& fit);
/// One page that needs nothing else, light or dark as its reader has it.
[[nodiscard]] std::string as_html(const Standing& standing, const Fit& fit,
                                  const std::optional<Room>& room);

/// What the scanner of a profile looks at.
struct Surroundings {
    std::string scene = {};  ///< as the configuration names it; empty: scipd's own world
    /// Where the scanner stands in a world; nothing: the scene is a room that was made of the same
    /// recording.
    std::optional<FlatPose> place = std::nullopt;
};

void write_profile(const Fit& fit, const Surroundings& surroundings, std::ostream& out);

}  // namespace scipd::tools
