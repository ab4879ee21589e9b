// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Tells the log of a scanner's boots, and who switches its laser on or off; of what happens more
// than once a second, only how often. Lives on the shard of the scanner.
#pragma once

#include <string>
#include <utility>

#include "daemon/limits/throttle.h"

namespace scipd::daemon {

class DeviceLog {
  public:
    enum class By { tcp_client, tty_client, fault, leaving_client, last_scan };

    explicit DeviceLog(std::string name) : name_(std::move(name)) {}

    /// It was so before anybody could ask.
    void know(bool laser_on) { laser_on_ = laser_on; }
    void booted(bool laser_on);
    /// To be called whenever the laser may have been switched.
    void laser(bool on, By by);

  private:
    std::string name_;
    bool laser_on_ = false;
    Throttle boots_;
    Throttle switches_;
};

}  // namespace scipd::daemon
