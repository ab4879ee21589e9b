// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads recordings into tapes, and finds out of which model a recording is. Any thread; nothing
// shared.
#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "daemon/config/replay_config.h"
#include "daemon/models/model.h"
#include "daemon/replay/tape.h"
#include "sim/recording/values/scanner_identity.h"

namespace scipd::daemon {

/// What a recording says of the scanner that it is of.
struct RecordedScanner {
    sim::ScannerIdentity identity;
    Model model;
};

/// The product that the recording names, or whose steps and range it has; else one of its own,
/// `recorded`. Throws sim::LoadError, with what to
/// do, where the recording cannot be read, or is of none.
[[nodiscard]] RecordedScanner recorded_scanner(const ReplayConfig& replay);

/// The scans as this model sends them. What has no step of its own on the model's wire is left out;
/// a step that was not recorded has the model's code for nothing. A warning says what the model has
/// no step or range for. Throws sim::LoadError, also soon after `stop`.
[[nodiscard]] SharedTape read_tape(const ReplayConfig& replay, const Model& model,
                                   std::vector<std::string>& warnings,
                                   const std::stop_token& stop = {});

}  // namespace scipd::daemon
