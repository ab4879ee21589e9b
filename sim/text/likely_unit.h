// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Guesses which unit somebody had in mind: degrees where radians are meant, millimetres where
// metres are. A guess is for a warning; the number stays what it is. Any thread; nothing shared.
#pragma once

#include <optional>
#include <span>
#include <string>

namespace scipd::sim {

/// "0, 0, 90 looks like degrees, but angles are radians; did you mean 0, 0, 1.5708?" Nothing unless
/// one of them is beyond a full turn and all have at most one decimal: what turns further and
/// further has more, while people write degrees so.
std::optional<std::string> degrees_for_radians(std::span<const double> angles_rad);

/// Whether they could be millimetres: one is 50 or more, none but 0 is below 1, and all have at
/// most one decimal. So are metres of a large world, so that more must speak for it.
bool could_be_millimetres(std::span<const double> lengths_m);

/// "200, 0, 250 looks like millimetres, but lengths are metres; did you mean 0.2, 0, 0.25?"
std::string millimetres_for_metres(std::span<const double> lengths_m);

}  // namespace scipd::sim
