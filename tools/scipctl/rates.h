// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a scipd did between two of its statuses. Values; one thread.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tools/control_client.h"

namespace scipd::tools {

struct SensorRates {
    std::string name;
    std::string model;
    std::string state;
    std::optional<double> scans_per_s;  ///< nothing: the sensor is new
    std::uint64_t lost = 0;             ///< scans, in all its life
    std::optional<double> lateness_p99_ms;
    std::uint64_t clients = 0;
    std::map<std::string, double> casts_per_s;  ///< by backend; without those that cast nothing
};

/// The rates of the sensors that the later status has. Both are answers to GET /status.
[[nodiscard]] std::vector<SensorRates> rates_between(const ControlClient::Json& earlier,
                                                     const ControlClient::Json& later);

/// As `scipctl top --json` writes it.
[[nodiscard]] ControlClient::Json to_json(const SensorRates& sensor);

}  // namespace scipd::tools
