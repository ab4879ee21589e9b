// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <cstdint>

namespace scipd::protocol {

/// A code that now and then stands where another mostly does.
struct RareCode {
    std::uint32_t code = 0;
    double inside = 0.0;  ///< its share of the steps without a distance whose neighbours have none
    double beside = 0.0;  ///< of those beside a distance
    double edge = 0.0;    ///< of those where two surfaces in one beam contradict each other
    bool alone = false;   ///< never at two steps side by side; others come in runs of four inside

    bool operator==(const RareCode&) const = default;
};

}  // namespace scipd::protocol
