// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What libsdformat 12 has printed, in words for whoever has the file. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "sim/loaders/sdf/stand_in.h"

namespace scipd::sim {

/// Each with the file and the line that the user has, as far as the library tells, and `file`
/// otherwise. Of elements and attributes that it does not know, each name once.
std::vector<std::string> in_plain_words(const std::vector<std::string>& printed,
                                        const std::map<std::string, StandIn>& stand_ins,
                                        const std::filesystem::path& file);

/// What it adds where it has said what is wrong.
bool is_printed_echo(const std::string& printed);

}  // namespace scipd::sim
