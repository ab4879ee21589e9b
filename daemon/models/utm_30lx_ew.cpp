// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// UTM-30LX-EW, firmware 1.1.0. Texts and limits as urg_stamped's simulator and urg_library have
// them, whose authors had units; no recording was seen.
#include "daemon/models/utm_30lx_ew.h"

namespace scipd::daemon {

Model utm_30lx_ew() {
    using namespace std::chrono_literals;
    const protocol::DeviceProfile profile{
        .name = "UTM-30LX-EW",
        .release = "1.1.0",
        .family = protocol::Family::b,

        .vendor = "Hokuyo Automatic Co., Ltd.",
        .product = "UTM-30LX-EW",
        .firmware = "1.1.0 (2011-09-30)",
        .protocol = "SCIP 2.2",
        .serial = "H0123456",  // made up in the form of the others

        .model = "UTM-30LX-EW",
        .dmin_mm = 23,
        .dmax_mm = 60000,
        .ares = 1440,
        .amin = 0,
        .amax = 1080,
        .afrt = 540,
        .scan_rpm = 2400,

        .motor_speed = "2400",
        .mode_idle = "000 Idle",
        .mode_measuring = "003 Single_scan",
        .mode_streaming = "004 Multi_scan",
        .mode_booting = "001 Booting",
        .bit_rate = "Ethernet 100 [Mbps]",
        .health = "Stable 000 no error.",
        // Deduced from the form of the one before and the numbers of %ST.
        .health_unstable = "Unstable 100 recovering.",
        .health_failed = "Error 900 abnormal.",
        .time_spelling = protocol::TimeSpelling::hexadecimal,

        .last_step = 1080,
        .nearest_mm = 23,
        // Undocumented: those of the UTM-30LX.
        .codes = {.nothing = 1, .too_near = 2, .too_far = 1, .not_measured = 5},

        .multi_echo = true,

        .unknown_command = protocol::status::undefined,
        .scan_period = 25ms,
        // A scan is sent right after its last step (urg_stamped's simulator).
        .reply_tick = 0ms,
        // Some seconds, in which it answers (urg_stamped); the figures are assumed.
        .boot_time = 5s,
        .answers_while_booting = true,
        .wake_time = 3s,
    };
    // Data sheet of the UTM-30LX, indoors: below 10 mm to 10 m, below 30 mm to 30 m.
    return make_model(profile, {{.from_range_m = 0.0, .sigma_m = 0.010, .sigma_share = 0.0},
                                {.from_range_m = 10.0, .sigma_m = 0.030, .sigma_share = 0.0}});
}

}  // namespace scipd::daemon
