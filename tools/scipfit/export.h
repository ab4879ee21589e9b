// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The noise of a profile in the words of other programs, each with what it cannot hold. One thread.
#pragma once

#include <iosfwd>

#include "sim/sensor/sensor_spec.h"

namespace scipd::tools {

/// Nav2's and ROS' AMCL: the beam model and the likelihood field.
void write_amcl(const sim::SensorSpec& optics, std::ostream& out);
/// Gazebo: <noise> of <lidar> in SDF.
void write_gz(const sim::SensorSpec& optics, std::ostream& out);
/// MVSim: a sensor of class laser.
void write_mvsim(const sim::SensorSpec& optics, std::ostream& out);
/// Stage: a ranger.
void write_stage(const sim::SensorSpec& optics, std::ostream& out);

}  // namespace scipd::tools
