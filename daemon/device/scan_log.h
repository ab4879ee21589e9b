// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The latest scans of a device, as they were cast and as they were sent: a second of them, for
// those who compare. What was kept stays as it was, in the scene of its time. Lives on the I/O
// thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>

#include "daemon/control/sensor_backends.h"
#include "daemon/device/bridge.h"
#include "sim/sensor/scan.h"
#include "sim/world/scene.h"

namespace scipd::daemon {

struct ScanRecord {
    sim::SharedScan cast;
    WireScan sent;
    std::uint32_t stamp_ms = 0;  ///< what the wire says of its time
    sim::SharedScene scene;      ///< that it was cast into: what its ids mean
    SharedChoice backend;        ///< what cast it
    int front_step = 0;
    int steps_per_turn = 0;
    sim::Time origin{};  ///< what people call world time 0 (Clock)

    /// A world time as people call it.
    [[nodiscard]] sim::Time told(sim::Time time) const { return origin + time; }
};

using SharedRecord = std::shared_ptr<const ScanRecord>;

class ScanLog {
  public:
    static constexpr sim::Time span = std::chrono::seconds(1);
    static constexpr std::size_t capacity = 64;

    void add(SharedRecord record);

    /// Null where there is none.
    [[nodiscard]] SharedRecord latest() const;
    [[nodiscard]] SharedRecord find(std::int64_t revolution) const;
    /// Of a log that holds something: the first and the last of the revolutions.
    [[nodiscard]] std::int64_t first() const { return records_.front()->cast->revolution; }
    [[nodiscard]] std::int64_t last() const { return records_.back()->cast->revolution; }

  private:
    std::deque<SharedRecord> records_;  ///< by growing revolution
};

}  // namespace scipd::daemon
