// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// UST-10LX-H01. Steps and range: specification C-42-04213. The texts are those of a UST-10LX. The
// serial number is made up.
#include "daemon/models/product_lines.h"
#include "daemon/models/products.h"

namespace scipd::daemon {

Model ust_10lx_h01() {
    protocol::DeviceProfile profile = ust_profile("UST-10LX-H01", "H1700001");
    double_resolution(profile);
    return make_model(profile, ust_optics(4.0),
                      {
                          .range = Evidence::documented,
                          .steps = Evidence::documented,
                          .rate = Evidence::documented,
                          .links = Evidence::documented,
                          .light = Evidence::documented,
                      });
}

}  // namespace scipd::daemon
