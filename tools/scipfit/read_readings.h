// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Recordings of one scanner, read into memory. One thread.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sim/recording/values/recording.h"
#include "tools/scipfit/readings.h"

namespace scipd::tools {

/// Reads all scans of the files, those of `stream` where it is not empty, else those of the first
/// stream that has scans. Scans that came twice count once. Throws WrongInput where a file cannot
/// be read, and where two are not of one scanner.
[[nodiscard]] Readings read_readings(std::span<const std::filesystem::path> files,
                                     const std::string& stream);

/// Adds the scans of a recording that is open.
void add_scans(sim::Recording& recording, const std::string& name, const std::string& stream,
               Readings& readings);

}  // namespace scipd::tools
