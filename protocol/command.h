// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One row of the command table: what a command looks like on the wire, who does what it asks for,
// and when.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>

#include "protocol/family.h"
#include "protocol/gate.h"
#include "protocol/status.h"

namespace scipd::protocol {

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

/// The next suitable scan will be the reply.
struct AnsweredByScan {};

/// What a handler leaves to be sent: a status alone, a whole message, or nothing yet.
using Response = std::variant<Status, std::string, AnsweredByScan>;

struct RequestContext;
/// Carries out a request that its state allows and that is as long as it should be. Where the
/// status is another than 00, nothing has changed (but 01 of a first RB).
using Handler = Response (*)(const RequestContext&);

struct Command {
    std::string_view code;
    Parameters parameters;
    Handler handler;
    DataFormat format;
    Feature needs;  ///< a model without it does not know the command
    Gates gates;

    [[nodiscard]] constexpr const Gate& gate(Family family) const { return gates[family]; }
    [[nodiscard]] constexpr bool brings_one_scan() const {
        return parameters == Parameters::window;
    }
    [[nodiscard]] constexpr bool brings_scans() const { return parameters == Parameters::scans; }
    [[nodiscard]] constexpr bool switches_laser_on() const {
        return code == "BM" || brings_scans();
    }
};

}  // namespace scipd::protocol
