// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What was found about fleets, as text and as a table. One thread.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "tools/scipbench/fleet_run.h"
#include "tools/scipbench/fleet_stages.h"

namespace scipd::tools {

/// The bare casts of all scans, as a share of all cores.
[[nodiscard]] double bare_share(const FleetRun& run, const StageCosts& costs);
[[nodiscard]] double share_of_all(const ProcessorUse& use_a_second);

void print_run_header(std::ostream& out);
/// One line, as soon as a run has ended.
void print_run(const FleetRun& run, const StageCosts& costs, std::ostream& out);

/// What a scan costs, and where its time goes.
void print_costs(const FleetRun& run, const StageCosts& costs, std::ostream& out);
void print_lateness(const FleetRun& run, std::ostream& out);

/// Why a fleet loses scans: what it ran out of, by what was measured of it.
[[nodiscard]] std::string what_limits(const FleetRun& run);

void write_runs_csv(const std::vector<FleetRun>& runs, const StageCosts& costs, std::ostream& out);

}  // namespace scipd::tools
