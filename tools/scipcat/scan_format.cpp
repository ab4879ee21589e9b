// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/scan_format.h"

#include <cstdio>

namespace scipd::tools {

std::string unix_seconds(HostTime time) {
    const auto since_1970 = time.time_since_epoch();
    const auto us = std::chrono::duration_cast<std::chrono::microseconds>(since_1970).count();
    char text[40];
    std::snprintf(text, sizeof text, "%lld.%06lld", static_cast<long long>(us / 1000000),
                  static_cast<long long>(us % 1000000));
    return text;
}

}  // namespace scipd::tools
