// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// UST-30LC. Limits and firmware: urg_stamped and its simulator, whose author had units. 4.0.3 is
// the firmware that mended the 5 ms tick of 4.0.0 to 4.0.2.
#include "daemon/models/product_lines.h"
#include "daemon/models/products.h"

namespace scipd::daemon {

Model ust_30lc(const std::string& firmware) {
    // The serial number is made up in the form of the others.
    protocol::DeviceProfile profile = ust_profile("UST-30LC", "H2200001");
    profile.release = firmware;
    profile.firmware = firmware;
    profile.dmin_mm = 23;
    profile.nearest_mm = 23;
    profile.dmax_mm = 60000;
    // Firmware 4.0.0 to 4.0.2 looks for commands on a tick of 1 ms. TM1 and scans wait for a tick
    // of 5 ms (urg_stamped).
    using namespace std::chrono_literals;
    const bool ticks = firmware.starts_with("4.0.2");
    if (ticks) {
        profile.reply_tick = 1ms;
        profile.reply_delay = 0ms;
        profile.time_tick = profile.scan_tick = 5ms;
        profile.scan_delay = 0ms;
    }
    // urg_stamped uses %TM and %ME from 4.1 of this line on.
    profile.microseconds = firmware.starts_with("4.1");
    // urg_stamped's simulator answers so. 0F is known of firmware 2.23 only.
    profile.unknown_command = protocol::status::undefined;
    return make_model(profile, ust_optics(12.0),
                      {
                          .texts = Evidence::documented,
                          .range = Evidence::documented,
                          .steps = Evidence::documented,
                          .rate = Evidence::documented,
                          .links = Evidence::documented,
                          .commands = Evidence::documented,
                          .turn = Evidence::documented,
                          .pace = ticks ? Evidence::documented : Evidence::deduced,
                      });
}

}  // namespace scipd::daemon
