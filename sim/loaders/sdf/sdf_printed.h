// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Rewords what libsdformat 12 prints, for the user who has the file. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "sim/loaders/sdf/stand_in.h"

namespace scipd::sim {

/// Each message begins with the user's file and line, as far as the library gives them, otherwise
/// with `file`. It reports each name of an unknown element or attribute only once.
std::vector<std::string> in_plain_words(const std::vector<std::string>& printed,
                                        const std::map<std::string, StandIn>& stand_ins,
                                        const std::filesystem::path& file);

/// Whether this only repeats that something is wrong, after a message that says what.
bool is_printed_echo(const std::string& printed);

}  // namespace scipd::sim
