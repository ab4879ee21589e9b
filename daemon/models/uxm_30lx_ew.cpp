// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// UXM-30LX-EW. No data of a real unit was seen. Its limits follow from 190 degrees in steps of 0.25
// and from 50 ms a turn. The rest is the UTM-30LX-EW. The serial number is made up, and so is the
// firmware: from 1.1 on urg_stamped expects %TM of all that is no UTM.
#include "daemon/models/product_lines.h"
#include "daemon/models/products.h"

namespace scipd::daemon {

protocol::DeviceProfile uxm_ew_profile(const std::string& name, const std::string& serial) {
    using namespace std::chrono_literals;
    protocol::DeviceProfile profile = ew_profile(name, serial);
    profile.release = "1.0.0";
    profile.firmware = "1.0.0 (2011-09-30)";
    take_uxm_limits(profile);
    profile.motor_speed = "1200";
    profile.scan_period = 50'100us;  // longer than nominal, as on the UTM-30LX-EW
    return profile;
}

Model uxm_30lx_ew() {
    return make_model(uxm_ew_profile("UXM-30LX-EW", "H1200001"), uxm_optics(), Sureness{});
}

}  // namespace scipd::daemon
