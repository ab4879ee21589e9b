// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Finds how many scanners one scipd on this machine can be, and how long it takes to be so many.
// One thread, but for what its parts say.
#pragma once

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

}  // namespace scipd::tools
