// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What must hold of the faults of a file, whatever bytes it has.
#pragma once

#include <cstdlib>
#include <string_view>

#include "sim/loaders/file/load_error.h"

namespace scipd::tests {

inline void require(bool holds) {
    if (!holds) std::abort();
}

/// There are some, and each names the file and can be shown.
inline void require_faults_of(std::string_view file, const sim::LoadError& error) {
    require(!error.faults().empty());
    for (const auto& fault : error.faults()) {
        require(fault.starts_with(file) && fault.substr(file.size()).starts_with(":"));
        for (const char c : fault)
            require(c >= ' ' && c <= '~');
    }
}

}  // namespace scipd::tests
