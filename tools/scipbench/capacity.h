// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Searches the largest number for which something holds, by asking for few. One thread.
#pragma once

#include <functional>
#include <optional>

namespace scipd::tools {

struct Capacity {
    int held = 0;                 ///< the largest number that held; 0: none did
    std::optional<int> too_many;  ///< the smallest that did not; none: the limit held
};

/// Asks for `first`, doubles it as long as that holds, up to `limit`, and then halves what lies
/// between, until that is a twentieth of the number.
Capacity find_capacity(int first, int limit, const std::function<bool(int)>& holds);

}  // namespace scipd::tools
