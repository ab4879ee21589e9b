// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How a rig is doing, which is all sensors of this daemon, and what it has counted. It is told as
// /status, as metrics and to systemd. Values; any thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "daemon/api/shared_status.h"
#include "daemon/config/reading_errors.h"
#include "daemon/device/sensor_counts.h"
#include "daemon/poses/source_report.h"
#include "sim/time.h"

namespace scipd::daemon {

struct SensorReport {
    std::string name;                           ///< "rescue/front"
    std::string model;                          ///< "UST-10LX"
    std::string backend;                        ///< what casts, never "auto"
    std::optional<std::string> backend_reason;  ///< what "auto" was settled by
    std::string state;                          ///< "standby", "measuring", ..
    std::optional<std::string> warning;         ///< about the place where it is
    std::optional<std::string> tcp;       ///< "127.0.0.1:10940", the port that was really taken
    std::optional<std::string> pty;       ///< the link
    std::optional<ReadingErrors> errors;  ///< nothing: a camera or ranger
    std::uint64_t seed = 0;               ///< of all that it does by chance
    std::uint64_t clients = 0;            ///< connected now
    std::vector<std::string> connected;   ///< these: HOST:PORT, or "tty"
    std::vector<std::string> waiting;     ///< until the TCP client disconnects
    std::vector<std::string> faults;      ///< kinds of those that act now
    SensorCounts counts;
    SensorCounts counts_before;     ///< of its predecessors of the same name
    std::uint64_t stream_lost = 0;  ///< scans that clients of /stream did not get
};

struct PosesReport {
    std::uint64_t accepted = 0;
    std::uint64_t refused = 0;
    std::optional<std::string> last_refusal;
    std::vector<SourceReport> sources;
};

struct RigReport {
    std::chrono::duration<double> uptime{};
    std::string clock;  ///< "wall" or "poses"
    sim::Time time{};
    std::string scene;
    std::vector<std::string> warnings;  ///< of the world
    PosesReport poses;
    std::map<std::string, std::uint64_t> limited;  ///< how often something was too much, by limit
    std::optional<SharedStatus> fleet;             ///< nothing: the world is this daemon's alone
    std::vector<SensorReport> sensors;
};

}  // namespace scipd::daemon
