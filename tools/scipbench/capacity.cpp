// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/capacity.h"

#include <algorithm>

namespace scipd::tools {
namespace {

Capacity doubled(int first, int limit, const std::function<bool(int)>& holds) {
    Capacity found;
    for (int next = std::min(first, limit);; next = std::min(2 * next, limit)) {
        if (!holds(next)) {
            found.too_many = next;
            return found;
        }
        found.held = next;
        if (next == limit) return found;
    }
}

}  // namespace

Capacity find_capacity(int first, int limit, const std::function<bool(int)>& holds) {
    constexpr int parts = 20;
    Capacity found = doubled(first, limit, holds);
    if (!found.too_many) return found;
    while (*found.too_many - found.held > std::max(1, found.held / parts)) {
        const int middle = found.held + (*found.too_many - found.held) / 2;
        if (holds(middle)) {
            found.held = middle;
        } else {
            found.too_many = middle;
        }
    }
    return found;
}

}  // namespace scipd::tools
