// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/models/model.h"

#include <utility>

namespace scipd::daemon {

std::string_view name_of(Evidence evidence) {
    switch (evidence) {
        case Evidence::seen:
            return "seen";
        case Evidence::measured:
            return "measured";
        case Evidence::documented:
            return "documented";
        case Evidence::deduced:
            return "deduced";
        case Evidence::assumed:
            return "assumed";
    }
    return "";
}

Model make_model(const protocol::DeviceProfile& profile, sim::SensorSpec optics,
                 Sureness sureness) {
    constexpr double m_per_mm = 1e-3;
    optics.steps_per_turn = profile.ares;
    optics.first_step = profile.amin;
    optics.last_step = profile.amax;
    optics.front_step = profile.afrt;
    optics.scan_period = profile.scan_period;
    optics.max_range_m = profile.dmax_mm * m_per_mm;
    return {.profile = profile, .optics = std::move(optics), .sureness = sureness};
}

}  // namespace scipd::daemon
