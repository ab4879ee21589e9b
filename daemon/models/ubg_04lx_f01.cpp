// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// UBG-04LX-F01, the "Rapid-URG". MODL and limits: a public source. 28 ms a turn: its specification.
// The other texts are those of a URG-04LX of the same years. The serial number is made up.
#include "daemon/models/product_lines.h"
#include "daemon/models/products.h"

namespace scipd::daemon {

Model ubg_04lx_f01() {
    using namespace std::chrono_literals;
    protocol::DeviceProfile profile = urg_profile();
    profile.name = "UBG-04LX-F01";
    profile.release = "3.3.00";
    profile.product = "SOKUIKI Sensor UBG-04LX-F01[Rapid-URG]";
    profile.firmware = "3.3.00(16/Apr./2008)";
    profile.serial = "H0800001";
    profile.scip1 = {};
    profile.model = "UBG-04LX-F01[Rapid-URG](Hokuyo Automatic Co., Ltd.)";
    profile.scan_rpm = 2142;  // 28 ms; another source hints at 2400
    profile.motor_speed = "Initial(2142[rpm])<-Default setting by user";
    profile.mode_measuring = "Measuring by Normal Mode";
    profile.mode_sensitive = "Measuring by Sensitive Mode";
    profile.intensity_codes = false;
    profile.sensitivity = protocol::Support::yes;
    profile.rehearsals = protocol::Support::yes;
    profile.scan_period = 28'056us;  // longer than nominal, as on the UTM-30LX-EW
    return make_model(profile, urg_optics(),
                      {
                          .range = Evidence::documented,
                          .steps = Evidence::documented,
                          .rate = Evidence::documented,
                          .links = Evidence::documented,
                      });
}

}  // namespace scipd::daemon
