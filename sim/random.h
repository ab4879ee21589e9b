// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Chance as a function: the same key always gives the same number, whatever was drawn before, on
// whichever thread.
#pragma once

#include <cstdint>

namespace scipd::sim {

/// What a number is for, so that two uses with the same key do not share their chance.
enum class Purpose : std::uint32_t { range_noise };

struct ChanceKey {
    std::uint64_t seed = 0;    ///< of the whole run
    std::uint64_t sensor = 0;  ///< stable over runs: derived from the sensor's name
    std::uint64_t scan = 0;
    std::uint32_t beam = 0;
    Purpose purpose = Purpose::range_noise;
};

/// One number of the normal distribution with mean 0 and standard deviation 1.
double standard_normal(const ChanceKey& key);

}  // namespace scipd::sim
