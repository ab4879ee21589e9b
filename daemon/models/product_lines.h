// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the products of one line (URG, UTM, UXM, UST) have in common. The file of a product begins
// with this data and changes what differs.
#pragma once

#include <string>

#include "protocol/device_profile.h"
#include "sim/sensor/sensor_spec.h"

namespace scipd::daemon {

/// The URG-04LX with firmware 3.1.04, the best known of the old models.
protocol::DeviceProfile urg_profile();
/// The UTM-30LX-EW, under another name.
protocol::DeviceProfile ew_profile(const std::string& name, const std::string& serial);
/// The UXM-30LX-EW, under another name.
protocol::DeviceProfile uxm_ew_profile(const std::string& name, const std::string& serial);
/// The UST-10LX with firmware 2.23, under another name.
protocol::DeviceProfile ust_profile(const std::string& name, const std::string& serial);

/// SCIP 2.0 specification, table 3: 1 and 2 are weak returns, 7 and 8 contradict their neighbours
/// or the other wave, 9 failed before, 18 is a strong reflector, 19 no step that is measured. All
/// but 2 and 18 were recorded. That 9 stands for another scanner's light and for what fails at
/// random is deduced.
protocol::DistanceCodes urg_codes();
/// SCIP 2.0 specification, table 4: 1 is nothing in range, 2 too near, 3 interference, 5 other.
/// hokuyo_node reads 1 as +inf and 2 as -inf.
protocol::DistanceCodes utm_codes();

// What they see (make_model). What no source is named for is assumed: the drift of a cold unit, the
// walk error, the length of a pulse and how phases contradict each other.

/// Noise: 10 mm to 1 m, then 1 % of the distance (data sheet of the URG-04LX). Spot: 40 mm at 4 m
/// (data sheet of the UG01). Kneip et al. (ICRA 2009) and Okubo et al. (2009) found that its bias
/// depends on the distance and that it drifts; their figures were not at hand, so those here are
/// assumed, within the accuracy of the data sheet. A dark target is seen to 4 m / 2.5, as with the
/// UST.
sim::SensorSpec urg_optics();
/// Noise: below 10 mm to 10 m, below 30 mm to 30 m (data sheet of the UTM-30LX, indoors). Bias: the
/// table of BlenSor's error model (Friedman 2013), which does not name its scanner; its range of 30
/// m suggests this one. Spot: 400 mm at 30 m, from memory. A dark target is seen to 30 m / 2.5, as
/// with the UST.
sim::SensorSpec utm_optics();
/// Noise: below 30 mm (data sheets of the UST). A face of 10 % is seen up to there (data sheets: 2
/// m for 5 m of a white one, 4 for 10, 8 for 20, 12 for 30). Spot as of the UTM. No bias is known.
sim::SensorSpec ust_optics(double dark_range_m);
/// As the UTM in light, as the UST in noise (data sheet, quoted from memory).
sim::SensorSpec uxm_optics();

/// Twice as many steps over the same angles.
void double_resolution(protocol::DeviceProfile& profile);

}  // namespace scipd::daemon
