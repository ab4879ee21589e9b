// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/models/product_lines.h"

namespace scipd::daemon {

std::vector<sim::NoiseStep> urg_noise() {
    return {{.from_range_m = 0.0, .sigma_m = 0.010, .sigma_share = 0.0},
            {.from_range_m = 1.0, .sigma_m = 0.0, .sigma_share = 0.01}};
}

std::vector<sim::NoiseStep> utm_noise() {
    return {{.from_range_m = 0.0, .sigma_m = 0.010, .sigma_share = 0.0},
            {.from_range_m = 10.0, .sigma_m = 0.030, .sigma_share = 0.0}};
}

std::vector<sim::NoiseStep> ust_noise() {
    return {{.from_range_m = 0.0, .sigma_m = 0.030, .sigma_share = 0.0}};
}

void double_resolution(protocol::DeviceProfile& profile) {
    for (int* steps :
         {&profile.ares, &profile.amin, &profile.amax, &profile.afrt, &profile.last_step})
        *steps *= 2;
}

}  // namespace scipd::daemon
