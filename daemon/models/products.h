// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Every product. Each has a source file of its own name. Only the registry calls these functions.
#pragma once

#include <string>

#include "daemon/models/model.h"

namespace scipd::daemon {

Model urg_04lx_3_1_04();
Model urg_04lx_3_3_00();
Model urg_04lx_ug01();
Model ubg_04lx_f01();
Model uhg_08lx();
Model utm_30lx();
Model utm_30lx_ew();
Model uxm_30lx_e();
Model uxm_30lx_ew();
Model uxm_30lxh_ewa();
Model ust_05lx();
Model ust_10lx();
Model ust_10lx_h01();
Model ust_10lx_h02();
Model ust_20lx();
Model ust_20lx_h01();
Model ust_30lx();
/// With firmware 1.0.1, 4.0.2-A, 4.0.3 or 4.1.0b-A.
Model ust_30lc(const std::string& firmware);

}  // namespace scipd::daemon
