// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Bytes and figures as people and programs can read them. No thread rule.
#pragma once

#include <string>
#include <string_view>

namespace scipd::tools::checks {

/// Printable ASCII as it is, all else as \n, \r, \\ or \xHH. Of long bytes the middle is left out,
/// and how many there were is told.
[[nodiscard]] std::string printable(std::string_view bytes);

/// A figure with one digit behind the point.
[[nodiscard]] std::string tenths(double value);

}  // namespace scipd::tools::checks
