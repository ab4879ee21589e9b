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
/// The UTM-30LX-EW, under another name.
protocol::DeviceProfile ew_profile(const std::string& name, const std::string& serial);
/// The UXM-30LX-EW, under another name.
protocol::DeviceProfile uxm_ew_profile(const std::string& name, const std::string& serial);
/// The UST-10LX with firmware 2.23, under another name.
protocol::DeviceProfile ust_profile(const std::string& name, const std::string& serial);

/// 10 mm to 1 m, then 1 % of the distance: data sheet of the URG-04LX.
std::vector<sim::NoiseStep> urg_noise();
/// Below 10 mm to 10 m, below 30 mm to 30 m: data sheet of the UTM-30LX, indoors.
std::vector<sim::NoiseStep> utm_noise();
/// Below 30 mm: data sheets of the UST and, quoted from memory, the UXM.
std::vector<sim::NoiseStep> ust_noise();

/// Twice as many steps over the same angles.
void double_resolution(protocol::DeviceProfile& profile);

}  // namespace scipd::daemon
