// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// UXM-30LX-E on USB. Texts, steps and limits: recording of a real unit. Its codes, and what it says
// when it is idle or broken, are those of the UTM-30LX: deduced.
#include "daemon/models/product_lines.h"
#include "daemon/models/products.h"

namespace scipd::daemon {

Model uxm_30lx_e() {
    using namespace std::chrono_literals;
    protocol::DeviceProfile profile = utm_profile();
    profile.name = "UXM-30LX-E";
    profile.release = "0.3.01";
    profile.product = "SOKUIKI Sensor Tough-URG UXM-30LX-E";
    profile.firmware = "0.3.01(11/Mar./2010)";
    profile.serial = "H0909106";
    profile.model = "UXM-30LX-E(Hokuyo Automatic Co.,Ltd.)";
    take_uxm_limits(profile);
    profile.motor_speed = "Initial(1200[rpm])";
    // That recording says CLASSIC later. The reason is unknown.
    profile.mode_measuring = "STANDARD(max:100000[mm])";
    profile.multi_echo = true;
    // Recorded: replies came 99.34 ms apart (ten of them; the device's clock counted 596 ms for
    // six), which is every second turn.
    profile.scan_period = 49'670us;
    profile.turns_per_reply = 2;
    return make_model(profile, uxm_optics(),
                      {
                          .texts = Evidence::seen,
                          .range = Evidence::seen,
                          .steps = Evidence::seen,
                          .rate = Evidence::seen,
                          .links = Evidence::seen,
                          .commands = Evidence::documented,
                          .turn = Evidence::seen,
                          .pace = Evidence::seen,
                          .noise = Evidence::measured,
                      });
}

}  // namespace scipd::daemon
