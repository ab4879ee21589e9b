// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a scanner says of itself: the answers to VV, PP and II, taken out of their messages. Each
// parser gives the answer, or a sentence that says what is wrong with the message. Values; no
// thread rule.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "protocol/client/message.h"

namespace scipd::protocol::client {

/// VV
struct Version {
    std::string vendor;
    std::string product;
    std::string firmware;
    std::string protocol;
    std::string serial;
};

/// PP; lengths in mm, angles in steps.
struct Parameters {
    std::string model;
    int dmin_mm = 0;
    int dmax_mm = 0;
    int ares = 0;  ///< steps in a full turn
    int amin = 0;
    int amax = 0;
    int afrt = 0;  ///< the step that looks forward
    int scan_rpm = 0;

    /// Counter-clockwise from forward; `step` may lie between two.
    [[nodiscard]] double angle_rad(double step) const;
    /// Anything else is one of the model's codes.
    [[nodiscard]] bool is_distance(std::uint32_t value) const {
        return value >= static_cast<std::uint32_t>(dmin_mm) &&
               value <= static_cast<std::uint32_t>(dmax_mm);
    }
};

/// II. A scanner out of order sends model and health only; the rest is then empty.
struct SensorState {
    std::string model;
    std::string laser;  ///< ON or OFF
    std::string motor_speed;
    std::string mode;
    std::string bit_rate;
    std::string time;                      ///< as sent; how it is spelt depends on the family
    std::optional<std::uint32_t> time_ms;  ///< the same read; nothing where it cannot be
    std::string health;
};

[[nodiscard]] std::variant<Version, std::string> parse_version(const Message& message);
[[nodiscard]] std::variant<Parameters, std::string> parse_parameters(const Message& message);
[[nodiscard]] std::variant<SensorState, std::string> parse_state(const Message& message);

}  // namespace scipd::protocol::client
