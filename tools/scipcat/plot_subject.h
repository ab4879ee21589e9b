// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is drawn: a scan, and who made it. A value; no thread rule.
#pragma once

#include <cstdint>
#include <string>

#include "sim/recording/values/recorded_scan.h"
#include "sim/recording/values/scanner_identity.h"
#include "tools/scipcat/scan_options.h"

namespace scipd::tools {

struct PlotSubject {
    sim::RecordedScan scan;
    sim::ScannerIdentity identity;
};

/// Uses a stream of one scan, which switches the laser on and off by itself. Throws
/// protocol::client::Error.
[[nodiscard]] PlotSubject subject_of(ConnectedScanner& scanner, const ScanOptions& options);

/// The scan of a stream with this number, from 1. Empty: the first stream. Throws WrongInput.
[[nodiscard]] PlotSubject subject_of(const std::string& recording, const std::string& stream,
                                     std::uint64_t number);

/// The scan looks where the model's steps do, and its limits are the model's, as far as the
/// recording says nothing else: as `scipd --replay --model` takes it. Throws WrongInput where there
/// is no such model, or the scan has not as many values as the model has steps.
void take_for_model(PlotSubject& subject, const std::string& model);

/// Which scanner, and which scan, as far as they are known.
[[nodiscard]] std::string scanner_text(const PlotSubject& subject);
[[nodiscard]] std::string scan_text(const PlotSubject& subject);

}  // namespace scipd::tools
