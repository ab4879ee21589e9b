// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// UST-05LX: half the steps of a UST-10LX. Limits: 0.5 degrees, 270 degrees and 25 ms; at most 15 m,
// from a public source. The texts are those of a UST-10LX. The serial number is made up.
#include "daemon/models/product_lines.h"
#include "daemon/models/products.h"

namespace scipd::daemon {

Model ust_05lx() {
    protocol::DeviceProfile profile = ust_profile("UST-05LX", "H1500005");
    profile.dmax_mm = 15000;
    profile.ares = 720;
    profile.amax = 540;
    profile.last_step = 540;
    profile.afrt = 270;
    return make_model(profile, ust_optics(2.0),
                      {
                          .range = Evidence::documented,
                          .links = Evidence::documented,
                          .light = Evidence::documented,
                      });
}

}  // namespace scipd::daemon
