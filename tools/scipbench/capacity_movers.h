// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Models that move in the world of a measurement: boxes that go round in circles, whose poses a
// thread of its own sends by UDP, as a simulator does. To be made and destroyed on one thread.
#pragma once

#include <cstdint>
#include <thread>
#include <vector>

#include "sim/world/pose.h"
#include "tools/control_client.h"

namespace scipd::tools {

class CapacityMovers {
  public:
    /// Adds a model at each place, and sends poses to this port of 127.0.0.1 from then on.
    CapacityMovers(ControlClient& scipd, std::uint16_t port, const std::vector<sim::Pose>& places);
    CapacityMovers(const CapacityMovers&) = delete;
    CapacityMovers& operator=(const CapacityMovers&) = delete;

  private:
    std::jthread sender_;
};

}  // namespace scipd::tools
