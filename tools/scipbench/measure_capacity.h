// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Finds the number of scanners that one scipd on this machine can be, by a search that asks for
// few, and the time that it takes to be so many. One thread, but for what its parts say.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "tools/scipbench/capacity_site.h"

namespace scipd::tools {

struct CapacityQuestion {
    CapacitySetup setup;
    std::optional<int> scanners;  ///< run so many, and search for no number
    std::optional<int> most;      ///< to search up to; none: as many as descriptors allow
    std::string csv;              ///< file to write
    std::string plot;             ///< picture to draw
};

/// Prints what it finds.
void measure_capacity(const CapacityQuestion& question);

/// How long scipd takes from exec until it is ready, and to answer GET /status then.
void measure_start(const CapacityQuestion& question);

struct Capacity {
    int held = 0;                 ///< the largest number that held; 0: none did
    std::optional<int> too_many;  ///< the smallest that did not; none: the limit held
};

/// Asks for `first`, doubles it as long as that holds, up to `limit`, and then halves what lies
/// between, until that is a twentieth of the number.
Capacity find_capacity(int first, int limit, const std::function<bool(int)>& holds);

}  // namespace scipd::tools
