// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string>
#include <vector>

#include "sim/loaders/load_error.h"
#include "tests/support/temp_dir.h"

namespace scipd::sim {

using tests::TempDir;

/// The faults of a call that must throw a LoadError, each without the folder's path wherever it
/// stands.
template <typename Call>
std::vector<std::string> faults_of(const Call& call, const TempDir& folder) {
    std::vector<std::string> faults;
    try {
        call();
    } catch (const LoadError& error) {
        faults = error.faults();
    }
    const auto prefix = folder.path().string() + '/';
    for (auto& fault : faults) {
        for (auto at = fault.find(prefix); at != fault.npos; at = fault.find(prefix)) {
            fault.erase(at, prefix.size());
        }
    }
    return faults;
}

}  // namespace scipd::sim
