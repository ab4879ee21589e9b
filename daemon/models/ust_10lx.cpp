// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// UST-10LX, and what all UST have in common with it. Texts with firmware 2.23: canned replies of a
// real unit.
#include "daemon/models/product_lines.h"
#include "daemon/models/products.h"

namespace scipd::daemon {

protocol::DeviceProfile ust_profile(const std::string& name, const std::string& serial) {
    using namespace std::chrono_literals;
    return {
        .name = name,
        .release = "2.23.0000",
        .family = protocol::Family::ust,

        .vendor = "Hokuyo Automatic Co., Ltd.",
        .product = name,
        .firmware = "2.23.0000",
        .protocol = "SCIP 2.2",
        .serial = serial,

        .model = name,
        .dmin_mm = 20,
        .dmax_mm = 30000,
        .ares = 1440,
        .amin = 0,
        .amax = 1080,
        .afrt = 540,
        .scan_rpm = 2400,

        .motor_speed = "2400",
        // It says so in every state: only LASR tells whether the laser is on.
        .mode_idle = "Measuring by Sensitive Mode",
        .mode_measuring = "Measuring by Sensitive Mode",
        .bit_rate = "Ethernet 100[Mbps]",
        .health = "sensor is working normally",
        // Deduced: no failing unit was seen.
        .health_unstable = "sensor is unstable",
        .health_failed = "sensor is out of order",
        .time_spelling = protocol::TimeSpelling::encoded,

        .last_step = 1080,
        // UST-10LX data sheet: it sends 4 below 21 mm, and 65533 beyond DMAX or if the return is
        // too weak.
        .nearest_mm = 21,
        .codes = {.nothing = 65533, .too_near = 4, .too_far = 65533, .not_measured = 65533},

        // Firmware 2.23 answers 0F where the specification says 0E.
        .unknown_command = protocol::status::unsupported,
        .scan_period = 25'050us,  // urg_stamped
        // A scan leaves on the next frame of 1 ms. TM is answered at once, as SCIP says (README of
        // urg_stamped), which takes 0.1 to 0.5 ms. II never takes less than 2 ms (on the UST-05LX
        // of urg_stamped's author).
        .scan_tick = 1ms,
        // Deduced from how urg_node calibrated two real ones (docs/protocol.md).
        .scan_delay = 4'500us,
        .settle_time = 50ms,
        .reply_delay = 400us,
        .state_report_delay = 2ms,
        // Deduced: the document says "the latest", but hokuyo_node and Rock's driver take two equal
        // stamps in a row as an error.
        .single_scan_is_next = true,
        // Boot: up to 10 s (UST-10LX data sheet), in which it accepts connections but does not
        // answer (urg_stamped). The time to wake up is assumed.
        .boot_time = 10s,
        .wake_time = 3s,
    };
}

Model ust_10lx() {
    return make_model(ust_profile("UST-10LX", "H1614934"), ust_optics(4.0),
                      {
                          .texts = Evidence::seen,
                          .range = Evidence::seen,
                          .steps = Evidence::seen,
                          .rate = Evidence::seen,
                          .links = Evidence::seen,
                          .commands = Evidence::documented,
                          .codes = Evidence::documented,
                          .turn = Evidence::documented,
                          .boot = Evidence::documented,
                          .noise = Evidence::measured,
                          .light = Evidence::documented,
                      });
}

}  // namespace scipd::daemon
