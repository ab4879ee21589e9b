// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// UST-20LX-H01: differs from the UST-20LX as the UST-10LX-H01 differs from the UST-10LX.
#include "daemon/models/product_lines.h"
#include "daemon/models/products.h"

namespace scipd::daemon {

Model ust_20lx_h01() {
    protocol::DeviceProfile profile = ust_profile("UST-20LX-H01", "H1700003");
    profile.dmax_mm = 60000;
    double_resolution(profile);
    return make_model(profile, ust_optics(8.0), Sureness{});
}

}  // namespace scipd::daemon
