// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// UXM-30LXH-EWA. No data of a real unit was seen. Its limits follow from 190 degrees in steps of
// 0.125 and from 50 ms a turn. 80 m is the data sheet's figure, quoted from memory. The rest is the
// UXM-30LX-EW. The serial number is made up.
#include "daemon/models/product_lines.h"
#include "daemon/models/products.h"

namespace scipd::daemon {

Model uxm_30lxh_ewa() {
    protocol::DeviceProfile profile = uxm_ew_profile("UXM-30LXH-EWA", "H1300001");
    profile.dmax_mm = 80000;
    double_resolution(profile);
    return make_model(profile, uxm_optics(), Sureness{});
}

}  // namespace scipd::daemon
