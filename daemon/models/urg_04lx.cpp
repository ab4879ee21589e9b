// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// URG-04LX, which speaks SCIP 2.0 from the start. Firmware 3.1.04: texts, steps and limits from a
// recording of a real unit. Firmware 3.3.00: version, serial number, steps and speed from a SCIP
// 1.1 recording of another unit; its range is that of 3.1.04.
#include "daemon/models/product_lines.h"
#include "daemon/models/products.h"

namespace scipd::daemon {
namespace {

// The reply to V of the same unit, recorded before SCIP2.0 was sent. The text of a failure is
// deduced.
protocol::Scip1Texts recorded_scip1() {
    return {.firmware = "3.1.04,07/08/02(20-4095[mm],240[deg],44-725[step],600[rpm])",
            .protocol = "00003,(SCIP 1.0)",
            .health = "FW Normal[FinalDist with shadow  ]",
            .health_failed = "FW Error[FinalDist with shadow  ]"};
}

}  // namespace

protocol::DeviceProfile urg_profile() {
    using namespace std::chrono_literals;
    return {
        .name = "URG-04LX",
        .release = "3.1.04",
        .family = protocol::Family::urg,

        .vendor = "Hokuyo Automatic Co.,Ltd.",
        .product = "SOKUIKI Sensor URG-04LX",
        .firmware = "3.1.04(02/Aug./2007)",
        .protocol = "SCIP 2.0",
        .serial = "H0706400",

        .scip1 = recorded_scip1(),

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
        .mode_measuring = "CLASSIC",
        .bit_rate = "19200[bps]<-Default setting by user",
        .health = "Sensor works well.",
        // Deduced: it has the form of the text that a failing UTM-30LX sends.
        .health_unstable = "Sensor is verifying an error.",
        .health_failed = "Trouble!! Error No. =[00->50]",
        .time_spelling = protocol::TimeSpelling::hexadecimal,

        // Clients may ask for steps 0 to 768 (SCIP 2.0 specification, table of models; a SCIP 1.1
        // recording reads all of them). Steps outside AMIN to AMAX read 19: so in that recording,
        // and steps 0 to 43 in all 661 scans of two units that urg_node asked for 0 to 725
        // (tysik/obstacle_detector, resources/scans_demo.bag).
        .last_step = 768,
        .nearest_mm = 20,
        .codes = urg_codes(),
        .rare_codes = urg_rare_codes(),

        .intensity_codes = true,  // undocumented; qrk's c_urg
        // SS and CR: SCIP 2.0 specification. HS came with 3.2.00 and DB with 3.3.00. Recorded: CR00
        // is answered with 03, HS0 with 0C.
        .bit_rates = {19200, 38400, 57600, 115200, 250000, 500000, 750000},
        .motor_levels = true,
        .sensitivity = protocol::Support::later_firmware,
        .rehearsals = protocol::Support::later_firmware,

        .unknown_command = protocol::status::undefined,
        // One reply a turn: the unit answered requests that came right after a reply 98 to 100 ms
        // later, 99.7 ms on average. The stamps of successive scans differ by 99 or 100 ms.
        .scan_period = 99'800us,
        .turns_per_reply = 1,
        .boot_time = 1s,  // assumed
    };
}

Model urg_04lx_3_1_04() {
    return make_model(urg_profile(), urg_optics(),
                      {
                          .texts = Evidence::seen,
                          .range = Evidence::seen,
                          .steps = Evidence::seen,
                          .rate = Evidence::seen,
                          .links = Evidence::documented,
                          .commands = Evidence::documented,
                          .codes = Evidence::measured,
                          .turn = Evidence::seen,
                          .pace = Evidence::seen,
                          .noise = Evidence::measured,
                      });
}

Model urg_04lx_3_3_00() {
    protocol::DeviceProfile profile = urg_profile();
    profile.release = "3.3.00";
    // Spelled as 3.1.04 spells it; the recording has the SCIP 1.1 form 3.3.00,08/04/16.
    profile.firmware = "3.3.00(16/Apr./2008)";
    profile.scip1.firmware = "3.3.00,08/04/16(20-4095[mm],240[deg],44-725[step],600[rpm])";
    profile.serial = "H0713090";
    // Seen on a URG-04LX-UG01 with 3.3.01.
    profile.mode_measuring = "Measuring by Normal Mode";
    profile.mode_sensitive = "Measuring by Sensitive Mode";
    profile.sensitivity = protocol::Support::yes;
    profile.rehearsals = protocol::Support::yes;
    return make_model(profile, urg_optics(),
                      {
                          .steps = Evidence::seen,
                          .rate = Evidence::seen,
                          .links = Evidence::documented,
                          .commands = Evidence::documented,
                          .codes = Evidence::measured,
                          .noise = Evidence::measured,
                      });
}

}  // namespace scipd::daemon
