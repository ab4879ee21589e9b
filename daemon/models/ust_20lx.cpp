// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// UST-20LX. PP: notes of a session with a real unit. The other texts are those of a UST-10LX. The
// serial number is made up.
#include "daemon/models/product_lines.h"
#include "daemon/models/products.h"

namespace scipd::daemon {

Model ust_20lx() {
    protocol::DeviceProfile profile = ust_profile("UST-20LX", "H1500001");
    profile.dmax_mm = 60000;
    return make_model(profile, ust_optics(8.0),
                      {
                          .range = Evidence::seen,
                          .steps = Evidence::seen,
                          .rate = Evidence::seen,
                          .links = Evidence::documented,
                          .commands = Evidence::documented,
                      });
}

}  // namespace scipd::daemon
