// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// UTM-30LX on USB. Texts, steps and limits: recording of a real unit.
#include "daemon/models/product_lines.h"
#include "daemon/models/products.h"

namespace scipd::daemon {

protocol::DeviceProfile utm_profile() {
    using namespace std::chrono_literals;
    return {
        .name = "UTM-30LX",
        .release = "P.1.05",
        .family = protocol::Family::utm_usb,

        .vendor = "Hokuyo Automatic Co.,Ltd.",
        .product = "SOKUIKI Sensor TOP-URG UTM-30LX",
        .firmware = "P.1.05(17/Apr./2009)",
        .protocol = "SCIP 2.0",
        // Digits only, with a leading 0, which hokuyo_node replaces with an H.
        .serial = "00903971",

        .model = "UTM-30LX(Hokuyo Automatic Co.,Ltd.)",
        .dmin_mm = 23,
        .dmax_mm = 60000,
        .ares = 1440,
        .amin = 0,
        .amax = 1080,
        .afrt = 540,
        .scan_rpm = 2400,

        .motor_speed = "Initial(2400[rpm])<-Default setting by user",
        // Recorded only with the laser on. IDLE is what the URG-04LX of the same generation says.
        .mode_idle = "IDLE",
        .mode_measuring = "CLASSIC",
        .bit_rate = "USB Full Speed",
        .health = "Sensor works well.",
        // The failure was seen on a unit with firmware 1.16.01. The unstable state is deduced.
        .health_unstable = "Sensor is verifying an error.",
        .health_failed = "Trouble!! Error No. =[00->33]",
        .time_spelling = protocol::TimeSpelling::hexadecimal,

        .last_step = 1080,
        .nearest_mm = 23,
        .codes = utm_codes(),

        .unknown_command = protocol::status::undefined,
        // Recorded: replies came 24.85 ms apart (nine of them, seen by USB polls of 1 ms); by the
        // device's clock five took 125 ms. A scan came 24 ms after its time stamp, 5 ms after its
        // last step. Hence one reply a turn of 25.0 ms.
        .scan_period = 25ms,
        .turns_per_reply = 1,
        .boot_time = 1s,  // assumed
    };
}

Model utm_30lx() {
    return make_model(utm_profile(), utm_optics(),
                      {
                          .texts = Evidence::seen,
                          .range = Evidence::seen,
                          .steps = Evidence::seen,
                          .rate = Evidence::seen,
                          .links = Evidence::seen,
                          .commands = Evidence::documented,
                          .codes = Evidence::documented,
                          .turn = Evidence::seen,
                          .pace = Evidence::seen,
                          .noise = Evidence::measured,
                      });
}

}  // namespace scipd::daemon
