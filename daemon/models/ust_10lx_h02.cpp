// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// UST-10LX-H02, with another wavelength and a small spot. Steps and range: specification
// C-42-04416. The texts are those of a UST-10LX. The serial number is made up.
#include <utility>

#include "daemon/models/product_lines.h"
#include "daemon/models/products.h"

namespace scipd::daemon {

Model ust_10lx_h02() {
    protocol::DeviceProfile profile = ust_profile("UST-10LX-H02", "H1700002");
    double_resolution(profile);
    sim::SensorSpec optics = ust_optics(4.0);
    optics.receiver.wavelength_nm = 830;
    // Its spot is small; how small is assumed.
    optics.footprint.half_width_rad = 0.003;
    optics.footprint.half_height_rad = 0.003;
    return make_model(profile, std::move(optics),
                      {
                          .range = Evidence::documented,
                          .steps = Evidence::documented,
                          .rate = Evidence::documented,
                          .links = Evidence::documented,
                          .light = Evidence::documented,
                      });
}

}  // namespace scipd::daemon
