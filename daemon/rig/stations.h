// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The sensors of a rig, each with what drives it and with the ports that reach it. A station
// lives on its shard; it is made, changed and looked at while that stands still.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "daemon/api/recordings.h"
#include "daemon/api/scan_stream.h"
#include "daemon/api/view_stream.h"
#include "daemon/api/wire_stream.h"
#include "daemon/config/config.h"
#include "daemon/config/reading_errors.h"
#include "daemon/config/sensor_config.h"
#include "daemon/device/scan_loop.h"
#include "daemon/link/link_counts.h"
#include "daemon/replay/replay.h"
#include "daemon/rig/ports.h"

namespace scipd::daemon {

class Device;
class FaultInjector;
class StaringSensor;
struct Shard;

/// One sensor and the ports that reach it.
struct Station {
    Station();
    Station(const Station&) = delete;
    Station& operator=(const Station&) = delete;
    ~Station();

    std::string robot;
    SensorConfig config;
    std::uint64_t seed = 0;
    std::size_t shard = 0;  ///< that it lives on
    /// A scanner, or a camera or ranger.
    std::variant<std::unique_ptr<Device>, std::unique_ptr<StaringSensor>> sensor;
    std::unique_ptr<ScanLoop> loop;
    SensorPorts ports;
    LinkCounts served_before;               ///< by its ports, for other sensors
    std::unique_ptr<FaultInjector> faults;  ///< null: a camera or ranger
    std::unique_ptr<ScanStream::Tap> tap;
    std::unique_ptr<ViewStream::Tap> view_tap;
    std::unique_ptr<WireStream::Tap> wire_tap;        ///< null: a camera or ranger
    std::unique_ptr<Recordings::Tap> recordings_tap;  ///< the same

    [[nodiscard]] std::string name() const { return sensor_name(robot, config.name); }
    /// From the next measurement on it sits there on its robot.
    void mount(const sim::Pose& robot_from_sensor);
    /// And reads with these errors. Nothing for cameras and rangers.
    void read_as(const ReadingErrors& errors);
    /// Ends its faults, and then its clients, as long as its world stands. On its own thread.
    void retire();
};

using Stations = std::vector<std::unique_ptr<Station>>;

/// What a station needs of its surroundings; all must outlive it.
struct StationContext {
    Shard& shard;
    ScanStream& stream;
    ViewStream& view;
    WireStream& wire;
    Recordings& recordings;
    std::atomic<int>& clients;  ///< of all scanners
    bool lockstep = false;
    Track track = {};  ///< that it plays; without a tape: it looks at the world
};

/// Switches a sensor on, behind its ports. These have been prepared, and so it does not fail.
[[nodiscard]] std::unique_ptr<Station> make_station(const StationContext& context,
                                                    const std::string& robot,
                                                    const SensorConfig& sensor, std::uint64_t seed,
                                                    SensorPorts ports);

/// By the sensor's full name; null: there is none.
[[nodiscard]] Station* find_station(const Stations& stations, const std::string& sensor);

/// The configuration with how its scanners read by now, where that was changed while they ran.
[[nodiscard]] Config as_it_reads(Config config, const Stations& stations);

/// The station of the same robot and seed whose sensor is configured like this; end(): there is
/// none.
[[nodiscard]] Stations::const_iterator find_unchanged(const Stations& stations,
                                                      const std::string& robot,
                                                      const SensorConfig& sensor,
                                                      std::uint64_t seed);
/// Takes that one out; null: there is none.
[[nodiscard]] std::unique_ptr<Station> take_unchanged(Stations& stations, const std::string& robot,
                                                      const SensorConfig& sensor,
                                                      std::uint64_t seed);

}  // namespace scipd::daemon
