// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sim/loaders/file/load_error.h"
#include "tests/support/temp_dir.h"

namespace scipd::sim {

using tests::TempDir;

/// Each without the folder's path wherever it stands.
inline std::vector<std::string> without_folder(std::vector<std::string> texts,
                                               const TempDir& folder) {
    const auto prefix = folder.path().string() + '/';
    for (auto& text : texts) {
        for (auto at = text.find(prefix); at != text.npos; at = text.find(prefix))
            text.erase(at, prefix.size());
    }
    return texts;
}

/// The faults of a call that must throw a LoadError, without the folder's path.
template <typename Call>
std::vector<std::string> faults_of(const Call& call, const TempDir& folder) {
    std::vector<std::string> faults;
    try {
        call();
    } catch (const LoadError& error) {
        faults = error.faults();
    }
    return without_folder(std::move(faults), folder);
}

}  // namespace scipd::sim
