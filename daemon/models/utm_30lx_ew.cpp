// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// UTM-30LX-EW, firmware 1.1.0. Texts and limits: urg_stamped's simulator and urg_library, whose
// authors had units. No recording was seen.
#include "daemon/models/product_lines.h"
#include "daemon/models/products.h"

namespace scipd::daemon {

protocol::DeviceProfile ew_profile(const std::string& name, const std::string& serial) {
    using namespace std::chrono_literals;
    return {
        .name = name,
        .release = "1.1.0",
        .family = protocol::Family::ethernet_multi_echo,

        .vendor = "Hokuyo Automatic Co., Ltd.",
        .product = name,
        .firmware = "1.1.0 (2011-09-30)",
        .protocol = "SCIP 2.2",
        .serial = serial,

        .model = name,
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
        // Deduced from the form of the text before it and from the numbers of %ST.
        .health_unstable = "Unstable 100 recovering.",
        .health_failed = "Error 900 abnormal.",
        .time_spelling = protocol::TimeSpelling::hexadecimal,

        .last_step = 1080,
        .nearest_mm = 23,
        // Undocumented: taken from the UTM-30LX.
        .codes = utm_codes(),

        .multi_echo = true,

        .unknown_command = protocol::status::undefined,
        .scan_period = 25'050us,  // urg_stamped
        // A scan leaves right after its last step, and a reply about 0.5 ms after its request
        // (urg_stamped's simulator).
        .reply_delay = 500us,
        .single_scan_is_next = true,  // as the UST
        // Boot: some seconds, in which it answers (urg_stamped). The figures are assumed.
        .boot_time = 5s,
        .answers_while_booting = true,
        .wake_time = 3s,
    };
}

// The serial number is made up in the form of the others.
Model utm_30lx_ew() {
    return make_model(ew_profile("UTM-30LX-EW", "H0123456"), utm_optics(),
                      {
                          .texts = Evidence::documented,
                          .range = Evidence::documented,
                          .steps = Evidence::documented,
                          .rate = Evidence::documented,
                          .links = Evidence::documented,
                          .commands = Evidence::documented,
                          .turn = Evidence::documented,
                          .pace = Evidence::documented,
                      });
}

}  // namespace scipd::daemon
