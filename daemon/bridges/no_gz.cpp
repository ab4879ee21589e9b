// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// In place of gz.cpp, in a build without Gazebo's transport.
#include <stdexcept>

#include "daemon/bridges/available.h"
#include "daemon/bridges/bus.h"

namespace scipd::daemon {

sim::Expected<> check_gz_is_built() {
    return sim::refuse(
        "this scipd was built without Gazebo's transport: install libignition-transport-dev "
        "(Debian "
        "12) or libgz-transport13-dev (packages.osrfoundation.org), and build it again");
}

std::unique_ptr<Bus> listen_to_gz(const std::vector<std::string>& /*topics*/,
                                  BusListener& /*listener*/) {
    throw std::runtime_error(check_gz_is_built().error().why);
}

}  // namespace scipd::daemon
