// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Takes the scans that are compared, from a scanner or from a recording. One thread.
#pragma once

#include <cstdint>
#include <string>

#include "tools/scipcat/compare/compare_series.h"
#include "tools/scipcat/scan_options.h"

namespace scipd::tools {

struct TakeOptions {
    ConnectionOptions connection;
    std::string stream;       ///< of a recording; empty: the first that has scans
    std::uint64_t scans = 0;  ///< 0: 100 of a scanner, and of a recording all
};

/// More scans than this are not taken of a recording: they need not fit into memory.
inline constexpr std::uint64_t most_compared = 10'000;

/// `letter` is A or B. Throws WrongInput where there are no scans, and Interrupted.
[[nodiscard]] comparing::Taken take_scans(const TakeOptions& options, const ScanOptions& scan,
                                          const std::string& letter);

}  // namespace scipd::tools
