// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Every command that is understood, as one table: its code, its parameters, what it does, and what
// each family answers in each state. Arity and state are refused before anything is carried out;
// tests walk the same table.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "protocol/answer.h"
#include "protocol/device_profile.h"
#include "protocol/status.h"

namespace scipd::protocol {

enum class Operation {
    report_version,
    report_parameters,
    report_state,
    report_state_number,
    switch_laser_on,
    quit,
    sleep,
    reset,
    partial_reset,
    reboot,
    single_shot,
    stream,
    enter_adjust,
    report_time,
    leave_adjust,
    refuse_digit,  ///< TM with anything but 0, 1 and 2
    set_bit_rate,
    set_motor_level,
    set_sensitivity,
    rehearse,
    set_address,
    choose_scip2,
};

/// The fixed-width digits after the code.
enum class Parameters {
    none,
    digit,      ///< 1
    number,     ///< 2
    rate,       ///< 6
    window,     ///< 10: start 4, end 4, cluster 2
    scans,      ///< 13: a window, interval 1, number of scans 2
    addresses,  ///< 36: address, mask and gateway, 3 for each octet
};

[[nodiscard]] constexpr std::size_t width(Parameters parameters) {
    switch (parameters) {
        case Parameters::none:
            return 0;
        case Parameters::digit:
            return 1;
        case Parameters::number:
            return 2;
        case Parameters::rate:
            return 6;
        case Parameters::window:
            return 10;
        case Parameters::scans:
            return 13;
        case Parameters::addresses:
            return 36;
    }
    return 0;
}

/// How the clock is written.
enum class Stamp {
    milliseconds,  ///< 4 characters, 24 bits
    microseconds,  ///< 11 characters, 64 bits
};

/// What stands behind the status line, and how the values of a step are written.
struct DataFormat {
    int width = 3;           ///< characters a value
    bool intensity = false;  ///< one more value after each distance
    bool echoes = false;     ///< every echo of a step, '&' between them
    bool io_lines = false;   ///< a line with the inputs and outputs of the device goes first
    Stamp stamp = Stamp::milliseconds;

    bool operator==(const DataFormat&) const = default;
};

/// What one family answers in each state instead of carrying a command out.
class Gate {
  public:
    /// One status per state in the order of State, "--" where the command is carried out, as in
    /// "10 -- -- 0E -- 50 --". Implicit: rows are written as literals.
    // NOLINTNEXTLINE(google-explicit-constructor)
    consteval Gate(const char (&row)[3 * state_count]) {
        for (std::size_t i = 0; i < state_count; ++i) {
            const char code[3] = {row[3 * i], row[3 * i + 1], '\0'};
            if (code[0] != '-') answers_[i] = Status(code);
        }
    }
    /// The family does not know the command.
    // NOLINTNEXTLINE(google-explicit-constructor)
    consteval Gate(std::nullptr_t) : known_(false) {}

    [[nodiscard]] constexpr bool known() const { return known_; }
    [[nodiscard]] constexpr std::optional<Status> refusal(State state) const {
        return answers_[static_cast<std::size_t>(state)];
    }

  private:
    bool known_ = true;
    std::array<std::optional<Status>, state_count> answers_{};
};

struct Command {
    std::string_view code;
    Parameters parameters;
    Operation operation;
    DataFormat format;
    std::array<Gate, 4> gates;  ///< in the order of Family
    Feature needs = Feature::common;

    [[nodiscard]] constexpr const Gate& gate(Family family) const {
        return gates[static_cast<std::size_t>(family)];
    }
};

[[nodiscard]] std::span<const Command> command_table();

/// What the model answers in this state instead of carrying the command out.
[[nodiscard]] std::optional<Status> refusal(const Command& command, State state,
                                            const DeviceProfile& profile);

/// The command that `line` begins with, the longest code first; null where the model knows none.
[[nodiscard]] const Command* find_command(std::string_view line, const DeviceProfile& profile);

}  // namespace scipd::protocol
