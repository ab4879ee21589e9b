// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// URG-04LX, firmware 3.1.04, in SCIP 2.0 from the start. Texts, steps and limits: recording of a
// real unit.
#include "daemon/models/urg_04lx.h"

namespace scipd::daemon {

Model urg_04lx() {
    using namespace std::chrono_literals;
    const protocol::DeviceProfile profile{
        .name = "URG-04LX",
        .release = "3.1.04",
        .family = protocol::Family::a1,

        .vendor = "Hokuyo Automatic Co.,Ltd.",
        .product = "SOKUIKI Sensor URG-04LX",
        .firmware = "3.1.04(02/Aug./2007)",
        .protocol = "SCIP 2.0",
        .serial = "H0706400",

        .model = "URG-04LX(Hokuyo Automatic Co.,Ltd.)",
        .dmin_mm = 20,
        .dmax_mm = 5600,
        .ares = 1024,
        .amin = 44,
        .amax = 725,
        .afrt = 384,
        .scan_rpm = 600,

        .motor_speed = "Initial(600[rpm])<-Default setting by user",
        .mode_idle = "IDLE",
        // 3.3 says "Measuring by Normal Mode" instead.
        .mode_measuring = "CLASSIC",
        .bit_rate = "19200[bps]<-Default setting by user",
        .health = "Sensor works well.",
        .time_spelling = protocol::TimeSpelling::hexadecimal,

        // Steps 0 to 768 exist and may be asked for (SCIP 2.0 specification, table of models; a
        // SCIP 1.1 recording reads all of them); outside AMIN to AMAX they read 19.
        .last_step = 768,
        .nearest_mm = 20,
        // SCIP 2.0 specification, table 3: 0 is by far the most frequent in recordings where
        // nothing is near enough; 10 to 17 are "other" errors, which drivers take as invalid, not
        // as far away.
        .codes = {.nothing = 0, .too_near = 10, .too_far = 0, .not_measured = 19},

        .unknown_command = protocol::status::undefined,
        .scan_period = 100ms,
        // One reply a turn: requests sent right after a reply were answered 98 to 100 ms later.
        .reply_tick = 100ms,
    };
    // Data sheet: 10 mm to 1 m, then 1 % of the distance.
    return make_model(profile, {{.from_range_m = 0.0, .sigma_m = 0.010, .sigma_share = 0.0},
                                {.from_range_m = 1.0, .sigma_m = 0.0, .sigma_share = 0.01}});
}

}  // namespace scipd::daemon
