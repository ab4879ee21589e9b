// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Scanners with errors that chance chose, and how often the fit of what they read holds the truth
// in its intervals.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tools/scipfit/fit.h"

namespace scipd::tests {

/// How often the interval of one parameter held the truth.
struct Hits {
    int inside = 0;
    int all = 0;
    std::vector<double> off;  ///< how far off, in half intervals
};

struct RoundTrip {
    std::map<std::string, Hits> parameters;
    int unknown_told = 0;  ///< numbers for what cannot be known
    int wrong_smoothing = 0;
    int wrong_lattice = 0;
};

/// Makes a scanner, a room and a recording by the seed, fits it, and compares.
void make_round_trip(std::uint64_t seed, RoundTrip& result);

}  // namespace scipd::tests
