// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// parse_config() answers any bytes with a configuration that is whole or with faults that can be
// shown; nothing else comes out of it.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "daemon/config.h"

namespace {

using namespace scipd::daemon;

void require(bool holds) {
    if (!holds) std::abort();
}

void check(const Config& config) {
    require(!config.robots.empty());
    require(config.scene.is_absolute());
    for (const auto& robot : config.robots) {
        require(!robot.name.empty() && !robot.sensors.empty());
        for (const auto& sensor : robot.sensors) {
            require(!sensor.name.empty());
            require(!sensor.model.profile.name.empty());
        }
    }
}

void check(const ConfigError& error) {
    require(!error.faults().empty());
    for (const auto& fault : error.faults()) {
        require(fault.starts_with("fleet.yaml:"));
        require(fault.find('\n') == fault.npos);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text{reinterpret_cast<const char*>(data), size};
    try {
        check(parse_config(text, "fleet.yaml"));
    } catch (const ConfigError& error) {
        check(error);
    }
    return 0;
}
