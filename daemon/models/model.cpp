// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/models/model.h"

#include <utility>

namespace scipd::daemon {

Model make_model(const protocol::DeviceProfile& profile, std::vector<sim::NoiseStep> noise) {
    constexpr double m_per_mm = 1e-3;
    return {.profile = profile,
            .optics = {.steps_per_turn = profile.ares,
                       .first_step = profile.amin,
                       .last_step = profile.amax,
                       .front_step = profile.afrt,
                       .scan_period = profile.scan_period,
                       .max_range_m = profile.dmax_mm * m_per_mm,
                       .noise = std::move(noise)}};
}

}  // namespace scipd::daemon
