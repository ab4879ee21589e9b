// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/child.h"

namespace scipd::tests {

/// The program's own path and these words.
inline std::vector<std::string> scipcat(std::vector<std::string> words) {
    // Only for builds with a leak sanitizer, which would blame scipcat for its libraries' caches.
    setenv("LSAN_OPTIONS", "print_suppressions=0:suppressions=" SCIPCAT_LEAKS, 1);
    words.insert(words.begin(), SCIPCAT);
    return words;
}

inline Outcome run_scipcat(std::vector<std::string> words) {
    return run(scipcat(std::move(words)));
}

}  // namespace scipd::tests
