// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// UXM-30LX-E on USB. Texts, steps and limits: recording of a real unit.
#include "daemon/models/product_lines.h"
#include "daemon/models/products.h"

namespace scipd::daemon {

Model uxm_30lx_e() {
    using namespace std::chrono_literals;
    const protocol::DeviceProfile profile{
        .name = "UXM-30LX-E",
        .release = "0.3.01",
        .family = protocol::Family::utm_usb,

        .vendor = "Hokuyo Automatic Co.,Ltd.",
        .product = "SOKUIKI Sensor Tough-URG UXM-30LX-E",
        .firmware = "0.3.01(11/Mar./2010)",
        .protocol = "SCIP 2.0",
        .serial = "H0909106",

        .model = "UXM-30LX-E(Hokuyo Automatic Co.,Ltd.)",
        .dmin_mm = 100,
        .dmax_mm = 100000,
        .ares = 1440,
        .amin = 0,
        .amax = 760,
        .afrt = 380,
        .scan_rpm = 1200,

        .motor_speed = "Initial(1200[rpm])",
        // Recorded only with the laser on. IDLE is what the URG-04LX of the same generation says.
        .mode_idle = "IDLE",
        // That recording says CLASSIC later. The reason is unknown.
        .mode_measuring = "STANDARD(max:100000[mm])",
        .bit_rate = "USB Full Speed",
        .health = "Sensor works well.",
        // Deduced from the UTM-30LX.
        .health_unstable = "Sensor is verifying an error.",
        .health_failed = "Trouble!! Error No. =[00->33]",
        .time_spelling = protocol::TimeSpelling::hexadecimal,

        .last_step = 760,
        .nearest_mm = 100,
        // Taken from the UTM-30LX.
        .codes = utm_codes(),
        .multi_echo = true,

        .unknown_command = protocol::status::undefined,
        // Recorded: replies came 99.34 ms apart (ten of them; the device's clock counted 596 ms for
        // six), which is every second turn.
        .scan_period = 49'670us,
        .turns_per_reply = 2,
        .boot_time = 1s,  // assumed
    };
    return make_model(profile, uxm_optics(),
                      {
                          .texts = Evidence::seen,
                          .range = Evidence::seen,
                          .steps = Evidence::seen,
                          .rate = Evidence::seen,
                          .links = Evidence::seen,
                          .commands = Evidence::documented,
                          .noise = Evidence::measured,
                      });
}

}  // namespace scipd::daemon
