// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One scipd with so many scanners, and `scipbench load` in a process of its own that reads and
// checks them all: what came of it. One thread, but for a bare timer beside.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/world/pose.h"
#include "tools/scipbench/capacity_site.h"
#include "tools/scipbench/processor_use.h"

namespace scipd::tools {

struct Late {
    double p50_ms = 0.0;
    double p99_ms = 0.0;
};

struct CapacityRun {
    int scanners = 0;
    std::string failure;  ///< why there is nothing to tell; empty: there is
    bool whole = false;   ///< the reader found nothing missing and nothing wrong
    double start_s = 0.0;
    double seconds = 0.0;
    std::uint64_t scans = 0;
    double scans_due = 0.0;     ///< by the time and the scanners' period
    std::uint64_t missing = 0;  ///< that the reader found missing, damaged or out of order
    std::uint64_t lost = 0;     ///< by scipd's own count
    double casts_us = 0.0;      ///< of a scan, by scipd's own count
    Late scipd;                 ///< by its own count: of the scanner in the middle
    double worst_p99_ms = 0.0;  ///< of the scanner that was worst
    Late reader;                ///< later than the soonest scan of a stream
    Late timer;                 ///< a bare timer beside, as often as a scanner turns
    ProcessorUse scipd_use;     ///< a second
    ProcessorUse reader_use;    ///< a second

    [[nodiscard]] bool loses() const { return !whole || lost > 0; }
    /// Whether it falls behind more and more. scipd loses scans only when they are a second late,
    /// which may be after the run. A stream begins with the second turn at the latest.
    [[nodiscard]] bool falls_behind() const {
        constexpr double enough = 0.95;
        return static_cast<double>(scans) + 2.0 * scanners < enough * scans_due;
    }
    [[nodiscard]] bool holds() const { return failure.empty() && !loses() && !falls_behind(); }
    [[nodiscard]] double scans_per_s() const {
        return seconds > 0.0 ? static_cast<double>(scans) / seconds : 0.0;
    }
};

/// The last of the places are those of models that move, as many as the setup has.
CapacityRun run_scanners(const CapacitySetup& setup, const std::vector<sim::Pose>& places);

}  // namespace scipd::tools
