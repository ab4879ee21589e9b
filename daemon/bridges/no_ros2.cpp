// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// In place of ros2.cpp, in a build without Cyclone DDS.
#include <stdexcept>

#include "daemon/bridges/available.h"
#include "daemon/bridges/bus.h"

namespace scipd::daemon {

sim::Expected<> check_ros2_is_built() {
    return sim::refuse(
        "this scipd was built without Cyclone DDS, by which it listens to ROS 2: install "
        "cyclonedds-dev and build it again, or take rosbridge:ws://HOST:9090/TOPIC");
}

std::unique_ptr<Bus> listen_to_ros2(const RosTopics& /*topics*/, BusListener& /*listener*/) {
    throw std::runtime_error(check_ros2_is_built().error().why);
}

}  // namespace scipd::daemon
