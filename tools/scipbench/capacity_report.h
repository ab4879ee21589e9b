// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What was found about so many scanners, as text and as a table. One thread.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "tools/scipbench/capacity_run.h"
#include "tools/scipbench/capacity_stages.h"

namespace scipd::tools {

/// The bare casts of all scans, as a share of all cores.
[[nodiscard]] double bare_share(const CapacityRun& run, const StageCosts& costs);
[[nodiscard]] double share_of_all(const ProcessorUse& use_a_second);

void print_run_header(std::ostream& out);
/// One line, as soon as a run has ended.
void print_run(const CapacityRun& run, const StageCosts& costs, std::ostream& out);

/// What a scan costs, and where its time goes.
void print_costs(const CapacityRun& run, const StageCosts& costs, std::ostream& out);
void print_lateness(const CapacityRun& run, std::ostream& out);

/// Why a run loses scans: what it ran out of, by what was measured of it.
[[nodiscard]] std::string what_limits(const CapacityRun& run);

void write_runs_csv(const std::vector<CapacityRun>& runs, const StageCosts& costs,
                    std::ostream& out);

}  // namespace scipd::tools
