// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The shard of each sensor of a configuration, and its ports, by keys that stay the same over a
// reload. Values; any thread.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>

namespace scipd::daemon {

struct Config;
struct KnownSensor;
struct SensorConfig;

/// The keys of one sensor; empty where it has no port of the kind.
struct PortKeys {
    std::string tcp;
    std::string pty;
};
[[nodiscard]] PortKeys port_keys(const std::string& robot, const SensorConfig& sensor);

/// The link of the sensor's tty, which it has.
[[nodiscard]] std::filesystem::path link_of(const std::string& robot, const SensorConfig& sensor);

/// Numbers of shards.
struct Homes {
    std::size_t shards = 1;                      ///< how many there are
    std::map<std::string, std::size_t> sensors;  ///< by name
    std::map<std::string, std::size_t> ports;    ///< by key
};

/// For this configuration, with all sensors mounted, where those are that run now. A sensor goes
/// where its tty is, or its TCP port, or its namesake; the others go where there is least to do, as
/// far as is `known`. What nobody has measured costs what the rays of the others cost. Throws
/// std::runtime_error where sensors that live apart would have to live together.
[[nodiscard]] Homes find_homes(const Config& config, const Homes& now,
                               const std::map<std::string, KnownSensor>& known);

}  // namespace scipd::daemon
