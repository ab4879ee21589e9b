// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which files somebody may name. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <vector>

namespace scipd::daemon {

/// Whether the file lies in or below one of the folders, wherever links and ".." lead. It may be
/// one of the folders, and need not be there.
bool lies_in_one_of(const std::vector<std::filesystem::path>& folders,
                    const std::filesystem::path& file);

}  // namespace scipd::daemon
