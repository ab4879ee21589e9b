// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// UHG-08LX. Steps: SCIP 2.0 specification C-42-03320B. Speed: UrgBenri. Range: a driver's
// recording of a real one (angusleigh/leg_tracker); the data sheet guarantees 8 m. The other texts
// are those of a URG-04LX of the same years. The serial number is made up.
#include "daemon/models/product_lines.h"
#include "daemon/models/products.h"

namespace scipd::daemon {

Model uhg_08lx() {
    using namespace std::chrono_literals;
    protocol::DeviceProfile profile = urg_profile();
    profile.name = "UHG-08LX";
    profile.release = "3.3.00";
    profile.product = "SOKUIKI Sensor UHG-08LX";
    profile.firmware = "3.3.00(16/Apr./2008)";
    profile.serial = "H0800002";
    profile.scip1 = {};
    profile.model = "UHG-08LX(Hokuyo Automatic Co.,Ltd.)";
    profile.dmin_mm = 30;
    profile.dmax_mm = 11'000;
    profile.amin = 0;
    profile.amax = 768;
    profile.scan_rpm = 900;
    profile.nearest_mm = 30;
    profile.motor_speed = "Initial(900[rpm])<-Default setting by user";
    profile.mode_measuring = "Measuring by Normal Mode";
    profile.mode_sensitive = "Measuring by Sensitive Mode";
    profile.intensity_codes = false;
    profile.sensitivity = protocol::Support::yes;
    profile.rehearsals = protocol::Support::yes;
    profile.scan_period = 66'667us;
    return make_model(profile, uhg_optics(),
                      {
                          .range = Evidence::documented,
                          .steps = Evidence::documented,
                          .rate = Evidence::documented,
                          .links = Evidence::documented,
                          .noise = Evidence::measured,
                      });
}

}  // namespace scipd::daemon
