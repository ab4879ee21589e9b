// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the products of one line (URG, UTM, UXM, UST) have in common. The file of a product begins
// with this data and changes what differs.
#pragma once

#include <string>
#include <vector>

#include "protocol/device_profile.h"
#include "sim/sensor/sensor_spec.h"

namespace scipd::daemon {

/// The URG-04LX with firmware 3.1.04, the best known of the old models.
protocol::DeviceProfile urg_profile();
/// The UTM-30LX on USB.
protocol::DeviceProfile utm_profile();
/// The UTM-30LX-EW, under another name.
protocol::DeviceProfile ew_profile(const std::string& name, const std::string& serial);
/// The UXM-30LX-EW, under another name.
protocol::DeviceProfile uxm_ew_profile(const std::string& name, const std::string& serial);
/// The UST-10LX with firmware 2.23, under another name.
protocol::DeviceProfile ust_profile(const std::string& name, const std::string& serial);

/// SCIP 2.0 specification, table 3: 7 contradicts its neighbours, 9 failed before, 18 is a strong
/// reflector, 19 no step that is measured. Too little light is 0: 1630 of 1706 steps at bright
/// aluminium that is met at more than 30 degrees (srLarsons/FaultModeling-for-2D-Laser-scanner).
/// That 9 stands for another scanner's light and for what fails at random is deduced; neither 9 nor
/// 18 was recorded in 1397 scans of two drives (simondlevy/BreezySLAM).
protocol::DistanceCodes urg_codes();
/// Shares of the first of these drives: 756 scans with 284 922 steps without a distance. 16 566 of
/// them are beside one distance and 907 between two. Of the latter those with a code other than 0
/// count as edges.
std::vector<protocol::RareCode> urg_rare_codes();
/// SCIP 2.0 specification, table 4: 1 is nothing in range, 2 too near, 3 interference, 5 other.
/// hokuyo_node reads 1 as +inf and 2 as -inf.
protocol::DistanceCodes utm_codes();

// What they see (make_model). The noise is that of recorded units, named with the repositories that
// hold the recordings; docs/errors.md sets figures side by side. The data sheets' accuracy bounds
// what a unit reads too far (sim/sensor/unit_bias.h), and is no noise. What no source is named for
// is assumed: the drift of a cold unit, the walk error, the length of a pulse and how phases
// contradict each other.

/// Noise: a URG-04LX before a white wall (srLarsons/FaultModeling-for-2D-Laser-scanner) and two in
/// a room (tysik/obstacle_detector), whose neighbours are those of a median of five beams: three
/// equal readings at a thing that is three beams wide, 50 % of neighbours equal on flat walls.
/// Accuracy: 10 mm to 1 m, then 1 % (data sheet). Spot: 40 mm at 4 m (data sheet of the UG01). That
/// white wall was read to 75 degrees, at 3.9 m, in every scan; so a dark target is seen to 3.2 m at
/// least.
sim::SensorSpec urg_optics();
/// As the URG, with the noise of a UHG-08LX in a room (angusleigh/leg_tracker). Accuracy: 30 mm to
/// 1 m, then 3 % (data sheet, from memory).
sim::SensorSpec uhg_optics();
/// Noise: a UTM-30LX in a room (yogeshgajjar/cartographer_data), a median of five beams as well:
/// its neighbours on flat walls correlate by 0.73, 0.49, 0.28, 0.12, and 48 % are equal. Accuracy:
/// 30 mm to 10 m, 50 mm to 30 m (data sheet). Spot: 400 mm at 30 m, from memory. A dark target is
/// seen to 30 m / 2.5, as with the UST.
sim::SensorSpec utm_optics();
/// Noise, intensities, what neighbours share: UST in a room (SkoltechRobotics/Eurobot2018). A third
/// to a seventh of all millimetres never occur there, hence a lattice. Accuracy: 40 mm (data
/// sheets). A face of 10 % is seen up to there (data sheets: 2 m for 5 m of a white one, 4 for 10,
/// 8 for 20, 12 for 30). Spot as of the UTM.
sim::SensorSpec ust_optics(double dark_range_m);
/// As the UTM, with the noise of one recorded scan of a UXM-30LX-E, in which a quarter of all
/// neighbours are equal.
sim::SensorSpec uxm_optics();

/// What a UXM-30LX reads and how fast it turns: 0.1 to 100 m, 190 degrees, 1200 rpm.
void take_uxm_limits(protocol::DeviceProfile& profile);

/// Twice as many steps over the same angles.
void double_resolution(protocol::DeviceProfile& profile);

}  // namespace scipd::daemon
