// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads recordings into tapes: finds the model of a recorded scanner, and its values for the steps
// of that model. Any thread; nothing shared.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "daemon/config/replay_config.h"
#include "daemon/models/model.h"
#include "daemon/replay/tape.h"
#include "sim/loaders/file/load_error.h"
#include "sim/recording/values/recorded_scan.h"
#include "sim/recording/values/scanner_identity.h"
#include "sim/sensor/sensor_spec.h"

namespace scipd::daemon {

/// The scanner of a recording, as far as the recording tells.
struct RecordedScanner {
    sim::ScannerIdentity identity;
    Model model;
    std::optional<sim::HostTime> first;   ///< time of its first scan
    std::optional<sim::HostTime> logged;  ///< by the clock of the recorder
};

/// Thrown where a recording of several scanners is played, and none of them is named.
class SeveralScanners : public sim::LoadError {
  public:
    using sim::LoadError::LoadError;
};

/// If `finds_model`, the model is the product that the recording names, or whose steps and range it
/// has; else one of its own, `recorded`. Throws sim::LoadError, with what to do, if the recording
/// cannot be read, or its model is wanted and not known.
[[nodiscard]] RecordedScanner recorded_scanner(const ReplayConfig& replay);

/// The names of the scanners of a recording, by which `stream` chooses. Reads all of it,
/// since topics may be empty. Throws
/// sim::LoadError, also soon after `stop`.
[[nodiscard]] std::vector<std::string> recorded_streams(const ReplayConfig& replay,
                                                        const std::stop_token& stop = {});

/// The scans as this model sends them, from a little before `from` on. Values without a step of
/// their own on the model's wire are left out; a step that was not recorded has the model's code
/// for nothing. A warning says what the model has no step or range for. Throws sim::LoadError, also
/// soon after `stop`.
[[nodiscard]] std::shared_ptr<Tape> read_tape(const ReplayConfig& replay, const Model& model,
                                              std::vector<std::string>& warnings,
                                              const std::stop_token& stop = {});

/// For each step that the scanner measures, the value of the scan that looks there; nothing: none
/// does. By SCIP's steps where the recording has them, else by angles, else one by one where there
/// are as many values as steps. Empty: nobody can tell.
[[nodiscard]] std::vector<std::optional<std::size_t>> map_of_steps(const sim::RecordedScan& scan,
                                                                   const sim::SensorSpec& optics);

}  // namespace scipd::daemon
