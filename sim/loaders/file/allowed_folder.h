// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which files somebody may name. A confined child that reads what a stranger has named is held to
// folders: from then on it opens no file elsewhere, whatever a file names in turn.
#pragma once

#include <filesystem>
#include <vector>

#include "sim/expected.h"

namespace scipd::sim {

using Folders = std::vector<std::filesystem::path>;

/// Whether the file lies in or below one of the folders, wherever links and ".." lead. It may be
/// one of the folders, and need not be there. Any thread; nothing shared.
bool lies_in_one_of(const Folders& folders, const std::filesystem::path& file);

/// In a confined child, and so in the children of that: nothing is read but what lies in these
/// folders.
void read_only_from(Folders folders);
/// The folders; null: all may be read.
[[nodiscard]] const Folders* folders_to_read();
/// What to say of other files.
constexpr const char* lies_in_no_folder =
    "lies in no folder that `allow` in the configuration names";
/// Ends a sentence that says of a file that it is not there: who must not read it learns nothing of
/// it. Empty where all may be read.
[[nodiscard]] std::string or_in_no_folder();
/// Whether this process may read the file.
[[nodiscard]] Expected<> check_allowed(const std::filesystem::path& file);

}  // namespace scipd::sim
