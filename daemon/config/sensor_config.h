// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a user wants one sensor to be. Plain values, complete and checked, as all of config.h.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "daemon/config/address.h"
#include "daemon/config/link_config.h"
#include "daemon/config/named_mount.h"
#include "daemon/config/replay_config.h"
#include "daemon/models/model.h"
#include "sim/backends/depth_options.h"
#include "sim/sensor/error_model.h"
#include "sim/sensor/staring.h"
#include "sim/world/pose.h"

namespace scipd::daemon {

/// An empty link stands for `auto`: a link in the run directory.
struct PtyConfig {
    std::filesystem::path link;

    bool operator==(const PtyConfig&) const = default;
};

enum class Timing {
    real,   ///< replies and scans leave on the grid of the firmware
    ideal,  ///< at once
};

/// As a backend: the fastest one that is right, which the daemon finds out by measuring.
inline constexpr std::string_view auto_backend = "auto";

/// How the daemon finds the device.
enum class PowerUp {
    scip2,  ///< powered and booted
    scip1,  ///< the same, in SCIP 1.1: only models that spoke it
    boot,   ///< just switched on: its boot time has begun
};

/// The device's own clock.
struct DeviceClockConfig {
    /// How much too fast it runs. Not said: not at all, or what a unit that others disturb has.
    std::optional<double> ppm{};
    std::uint32_t start_ms = 0;  ///< what it shows at the start
    /// How long after power-up the mirror first passes step 0. Not said: a chance of each scanner.
    std::optional<std::chrono::nanoseconds> phase{};

    bool operator==(const DeviceClockConfig&) const = default;
};

/// What people call a sensor: "rescue/front".
inline std::string sensor_name(const std::string& robot, const std::string& sensor) {
    return robot + "/" + sensor;
}

/// What its tty is called in the run directory, unless the user names one: "rescue-front".
inline std::string tty_name(const std::string& robot, const std::string& sensor) {
    return robot + "-" + sensor;
}

struct SensorConfig {
    std::string name;  ///< of the sensor alone: "front"
    Model model;       ///< with what the configuration overrides
    /// Set for a camera or a ranger. It speaks no SCIP and has no wire: model, tcp, pty, timing,
    /// power_up, clock and link mean nothing then.
    std::optional<sim::StaringSpec> staring;
    std::optional<ReplayConfig> replay;  ///< it plays a recording, and looks at no world
    sim::Pose robot_from_sensor;         ///< of a named mount: known once the world is loaded
    std::optional<NamedMount> mount;     ///< nothing: the user gave robot_from_sensor in numbers
    std::optional<Address> tcp;
    std::optional<PtyConfig> pty;
    std::string backend{auto_backend};
    sim::DepthOptions depth;  ///< where the backend is a depth buffer, or auto takes one
    sim::Accuracy accuracy = sim::Accuracy::sensor;
    double noise = 1.0;  ///< of a scanner: so many times the model's
    /// Which echo a scanner tells that tells one, where the accuracy is material.
    sim::EchoChoice echo = sim::EchoChoice::strongest;
    /// Other scanners of the world disturb it where they look at each other.
    bool interference = false;
    /// How many poses a sweep has, or a measurement of a camera or ranger; nothing: one a beam.
    std::optional<int> motion;
    Timing timing = Timing::real;
    PowerUp power_up = PowerUp::scip2;
    DeviceClockConfig clock;
    LinkConfig link;
    /// How long scans wait for poses that are late.
    std::chrono::nanoseconds wait_for_poses{};
    bool sees_body = false;  ///< the robot's own body can stand in its way, too

    bool operator==(const SensorConfig&) const = default;

    /// Whether the light that comes back decides what it reads.
    [[nodiscard]] bool sees_light() const {
        return !staring && !replay && accuracy == sim::Accuracy::material;
    }
};

}  // namespace scipd::daemon
