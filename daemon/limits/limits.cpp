// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/limits/limits.h"

#include <chrono>

#include <spdlog/spdlog.h>

namespace scipd::daemon {

std::string beyond(Limit limit, int value) {
    const LimitRow& row = limit_table[place_of(limit)];
    std::string text{row.beyond};
    text.replace(text.find('@'), 1, std::to_string(value));
    return text + "; " + std::string(row.key) + " under limits in the configuration allows more";
}

std::string Limits::refuse(Limit limit, std::string_view who) {
    std::string why = beyond(limit, values_[limit]);
    const std::lock_guard lock(mutex_);
    ++refused_[place_of(limit)];
    if (const auto others = told_[place_of(limit)].admit(std::chrono::steady_clock::now()))
        spdlog::warn("{}: {}{}", who, why, *others);
    return why;
}

}  // namespace scipd::daemon
