// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// URG-04LX-UG01, the "Simple-URG": USB only. VV: notes of a session with a real unit with firmware
// 3.4.03. PP, MODL and MESM: the URG-04LX's, which a unit with firmware 3.3.01 also sent.
#include "daemon/models/product_lines.h"
#include "daemon/models/products.h"

namespace scipd::daemon {

Model urg_04lx_ug01() {
    protocol::DeviceProfile profile = urg_profile();
    profile.name = "URG-04LX-UG01";
    profile.release = "3.4.03";
    profile.product = "SOKUIKI Sensor URG-04LX-UG01(Simple-URG)";
    profile.firmware = "3.4.03(17/Dec./2012)";
    profile.serial = "H1510998";
    profile.scip1 = {};
    profile.mode_measuring = "Measuring by Normal Mode";
    profile.mode_sensitive = "Measuring by Sensitive Mode";
    profile.bit_rate = "USB only";  // one of the texts that hokuyoaist reads
    profile.bit_rates = {};
    profile.sensitivity = protocol::Support::yes;
    profile.rehearsals = protocol::Support::yes;
    return make_model(profile, urg_optics(),
                      {
                          .texts = Evidence::seen,
                          .range = Evidence::seen,
                          .steps = Evidence::seen,
                          .rate = Evidence::seen,
                          .links = Evidence::documented,
                          .commands = Evidence::documented,
                      });
}

}  // namespace scipd::daemon
