// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Refusals as tests compare them. Any thread.
#pragma once

#include <optional>
#include <string>

namespace scipd::tests {

/// The sentence of the fault; nothing where there is none.
template <class Expected>
std::optional<std::string> why_not(const Expected& outcome) {
    if (outcome) return std::nullopt;
    return outcome.error().why;
}

}  // namespace scipd::tests
