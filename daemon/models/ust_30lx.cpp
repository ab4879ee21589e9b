// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// UST-30LX. hokuyolx names it. All else is that of the UST-20LX. The serial number is made up.
#include "daemon/models/product_lines.h"
#include "daemon/models/products.h"

namespace scipd::daemon {

Model ust_30lx() {
    protocol::DeviceProfile profile = ust_profile("UST-30LX", "H1900001");
    profile.dmax_mm = 60000;
    return make_model(profile, ust_optics(12.0), Sureness{});
}

}  // namespace scipd::daemon
