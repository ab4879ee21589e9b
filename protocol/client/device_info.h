// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a scanner reports about itself: its answers to VV, PP and II, read from their messages. Each
// parser returns the answer, or a sentence that says what is wrong with the message. Values; no
// thread rule.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "protocol/client/message.h"

namespace scipd::protocol::client {

/// The answer to VV.
struct Version {
    std::string vendor;
    std::string product;
    std::string firmware;
    std::string protocol;
    std::string serial;
};

/// The answer to PP; lengths in mm, angles in steps.
struct Parameters {
    std::string model;
    int dmin_mm = 0;
    int dmax_mm = 0;
    int ares = 0;  ///< steps in a full turn
    int amin = 0;
    int amax = 0;
    int afrt = 0;  ///< the step that looks forward
    int scan_rpm = 0;

    /// Counter-clockwise from forward. `step` may be a fraction.
    [[nodiscard]] double angle_rad(double step) const;
    /// Other values are codes of the model.
    [[nodiscard]] bool is_distance(std::uint32_t value) const {
        return value >= static_cast<std::uint32_t>(dmin_mm) &&
               value <= static_cast<std::uint32_t>(dmax_mm);
    }
};

/// The answer to II. A failing scanner sends model and health only; the rest is then empty.
struct SensorState {
    std::string model;
    std::string laser;  ///< ON or OFF
    std::string motor_speed;
    std::string mode;
    std::string bit_rate;
    std::string time;                      ///< as sent; each family has its own format
    std::optional<std::uint32_t> time_ms;  ///< `time` as a number, if it can be read
    std::string health;
};

[[nodiscard]] std::variant<Version, std::string> parse_version(const Message& message);
[[nodiscard]] std::variant<Parameters, std::string> parse_parameters(const Message& message);
[[nodiscard]] std::variant<SensorState, std::string> parse_state(const Message& message);

}  // namespace scipd::protocol::client
