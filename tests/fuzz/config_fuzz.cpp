// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Any bytes as a configuration: parse_config() returns a whole configuration or faults that can be
// shown, and throws nothing else.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "daemon/config/config_file.h"
#include "daemon/models/profile_check.h"

namespace {

using namespace scipd::daemon;

void require(bool holds) {
    if (!holds) std::abort();
}

void check(const scipd::sim::StaringSpec& spec) {
    require(!spec.directions().empty());
    require(spec.period > scipd::sim::Time::zero());
    require(spec.min_range_m >= 0.0 && spec.min_range_m < spec.max_range_m);
}

void check(const SensorConfig& sensor) {
    if (sensor.staring) return check(*sensor.staring);
    const auto& [profile, optics, sureness, own_serial, own_bias] = sensor.model;
    require(!sensor.name.empty() && !profile.name.empty());
    require(faults_of(profile).empty());
    Model same = make_model(profile, optics, sureness);
    same.own_serial = own_serial;
    same.own_bias = own_bias;
    require(sensor.model == same);
    require(sensor.power_up != PowerUp::scip1 || profile.speaks_scip1());
    require(sensor.link.jitter <= sensor.link.latency);
    require(!sensor.link.baud || sensor.pty);
}

void check(const Config& config) {
    require(!config.robots.empty());
    require(config.scene.is_absolute());
    for (const auto& robot : config.robots) {
        require(!robot.name.empty() && !robot.sensors.empty());
        for (const auto& sensor : robot.sensors)
            check(sensor);
    }
}

void check(const scipd::sim::LoadError& error) {
    require(!error.faults().empty());
    for (const auto& fault : error.faults()) {
        require(fault.starts_with("rig.yaml:"));
        require(fault.find('\n') == fault.npos);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text{reinterpret_cast<const char*>(data), size};
    try {
        check(parse_config(text, "rig.yaml"));
    } catch (const scipd::sim::LoadError& error) {
        check(error);
    }
    return 0;
}
