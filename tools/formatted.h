// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Numbers in sentences. Any thread; nothing shared.
#pragma once

#include <cstdio>
#include <string>

namespace scipd::tools {

/// As printf does; what does not fit is cut off.
template <typename... Values>
std::string formatted(const char* pattern, Values... values) {
    char text[300];
    std::snprintf(text, sizeof text, pattern, values...);
    return text;
}

}  // namespace scipd::tools
