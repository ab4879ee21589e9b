// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Makes the checks one after the other, and keeps what came of each. One thread.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "tools/scipcat/check/check_report.h"
#include "tools/scipcat/check/conversation.h"

namespace scipd::tools::checks {

struct Wanted {
    std::vector<std::string> sections;  ///< "4" or "4.2"; none: all of them
    bool unsafe = false;
};

/// Called before each check, with how many were made of how many.
using Progress = std::function<void(std::size_t done, std::size_t of, const Check& next)>;

/// Throws protocol::client::Error if no scanner answers at the place. What goes wrong later makes
/// checks fail. Ends early if the user wants it.
[[nodiscard]] CheckReport run_checks(const Conversation::Place& place, const Wanted& wanted,
                                     const Progress& progress);

}  // namespace scipd::tools::checks
