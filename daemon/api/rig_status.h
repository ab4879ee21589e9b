// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How a rig is doing: all sensors of this daemon. Values; any thread.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "daemon/api/shared_status.h"
#include "daemon/config/reading_errors.h"
#include "sim/time.h"

namespace scipd::daemon {

/// How long after their ideal instant scans left: less than 2^octave microseconds for each of these
/// octaves, or later.
inline constexpr std::array<int, 14> lateness_octaves{4,  5,  6,  7,  8,  9,  10,
                                                      11, 12, 13, 14, 15, 16, 17};
struct LatenessStatus {
    std::chrono::duration<double, std::milli> p50{};
    std::chrono::duration<double, std::milli> p99{};
    std::chrono::duration<double, std::milli> max{};
    /// How many left so late, but not as late as the octave before; the last: later than all.
    std::array<std::uint64_t, lateness_octaves.size() + 1> counts{};
};

struct SensorStatus {
    std::string name;                           ///< "rescue/front"
    std::string model;                          ///< "UST-10LX"
    std::string backend;                        ///< what casts, never "auto"
    std::optional<std::string> backend_reason;  ///< what "auto" was settled by
    std::string state;                          ///< "standby", "measuring", ..
    std::optional<std::string> warning;         ///< about the place where it is
    std::optional<std::string> tcp;       ///< "127.0.0.1:10940", the port that was really taken
    std::optional<std::string> pty;       ///< the link
    std::optional<ReadingErrors> errors;  ///< nothing: a camera or ranger
    std::uint64_t clients = 0;            ///< connected now
    std::uint64_t scans = 0;
    std::map<std::string, std::uint64_t> casts;  ///< by backend
    std::uint64_t lost = 0;                      ///< scans that drivers did not get
    std::uint64_t stream_lost = 0;               ///< and clients of /stream
    std::optional<LatenessStatus> lateness;      ///< nothing: no scan yet
};

struct PosesStatus {
    std::uint64_t accepted = 0;
    std::uint64_t refused = 0;
    std::optional<std::string> last_refusal;
};

struct RigStatus {
    std::chrono::duration<double> uptime{};
    std::string clock;  ///< "wall" or "poses"
    sim::Time time{};
    std::string scene;
    std::vector<std::string> warnings;  ///< of the world
    PosesStatus poses;
    std::optional<SharedStatus> fleet;  ///< nothing: the world is this daemon's alone
    std::vector<SensorStatus> sensors;
};

}  // namespace scipd::daemon
