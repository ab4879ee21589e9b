// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The backends of this build, for tests that hold for each of them. Any thread.
#pragma once

#include <string>
#include <vector>

#include "sim/backends/registry.h"

namespace scipd::tests {

inline std::vector<std::string> backend_names() {
    std::vector<std::string> names;
    for (const sim::BackendRow& row : sim::backends())
        names.emplace_back(row.name);
    return names;
}

/// As messages list them: "a, b, c".
inline std::string listed_backends() {
    std::string list;
    for (const std::string& name : backend_names())
        list += (list.empty() ? "" : ", ") + name;
    return list;
}

}  // namespace scipd::tests
