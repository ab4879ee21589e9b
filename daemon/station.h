// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "daemon/api/scan_stream.h"
#include "daemon/config/config.h"
#include "daemon/device/device.h"
#include "daemon/device/scan_loop.h"
#include "daemon/device/staring_sensor.h"
#include "daemon/link/pty_port.h"
#include "daemon/link/tcp_port.h"

namespace scipd::daemon {

/// One sensor and what it is reached by.
struct Station {
    std::string robot;
    SensorConfig config;
    std::uint64_t seed = 0;
    std::unique_ptr<Device> device;          ///< null where it stares
    std::unique_ptr<StaringSensor> staring;  ///< null where it is a scanner

    [[nodiscard]] std::string name() const { return sensor_name(robot, config.name); }

    std::unique_ptr<ScanLoop> loop;
    std::shared_ptr<TcpPort> tcp;
    std::shared_ptr<PtyPort> pty;
    std::unique_ptr<ScanStream::Tap> tap;
};
}  // namespace scipd::daemon
