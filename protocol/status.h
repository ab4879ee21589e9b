// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The two characters after the echo of every reply: what became of the request.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace scipd::protocol {

class Status {
  public:
    /// Two characters, checked when compiled. Implicit: a literal is a status.
    // NOLINTNEXTLINE(google-explicit-constructor)
    consteval Status(const char (&code)[3]) : code_{code[0], code[1]} {
        if (!valid(code[0]) || !valid(code[1])) throw "a status is two of 0-9 and A-Z";
    }

    [[nodiscard]] static constexpr std::optional<Status> parse(std::string_view code) {
        if (code.size() != 2 || !valid(code[0]) || !valid(code[1])) return std::nullopt;
        return Status(code[0], code[1]);
    }

    [[nodiscard]] constexpr std::string_view text() const { return {code_.data(), code_.size()}; }
    constexpr bool operator==(const Status&) const = default;

  private:
    constexpr Status(char first, char second) : code_{first, second} {}
    static constexpr bool valid(char c) { return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z'); }

    std::array<char, 2> code_;
};

/// Three statuses of the specification are never sent, as nothing here leads to them:
///   0A  The scanner cannot make the data: here it always can.
///   0B  Buffers are full, or a command came again too soon: no recording shows it, and drivers
///       that repeat a command take it for a failure. Here all requests are answered in order, and
///       a session that is full lets its shell wait.
///   0I  The scanner waits for new firmware: here it takes none.
namespace status {

// These mean the same whatever the command.
inline constexpr Status ok{"00"};
inline constexpr Status denied{"10"};     ///< not in the present state; old models: laser off
inline constexpr Status too_short{"0C"};  ///< also: the firmware is older than the command
inline constexpr Status too_long{"0D"};
inline constexpr Status undefined{"0E"};
inline constexpr Status unsupported{"0F"};
inline constexpr Status string_too_long{"0G"};
inline constexpr Status string_illegal{"0H"};
inline constexpr Status abnormal{"0L"};

// In a stream, before a scan or in its place.
inline constexpr Status scan_follows{"99"};
inline constexpr Status unstable{"0M"};   ///< this scan is left out
inline constexpr Status verifying{"21"};  ///< old models: the stream pauses to verify an error
inline constexpr Status resumed{"98"};    ///< old models: the stream goes on
inline constexpr Status broken{"50"};     ///< old models: the stream has ended for good

// The meaning of a number from 01 to 07 depends on the command.

/// GD, MD and all other commands for scans, in the order of their parameters.
namespace scan {
inline constexpr Status start_not_numeric{"01"};
inline constexpr Status end_not_numeric{"02"};
inline constexpr Status cluster_not_numeric{"03"};
inline constexpr Status no_such_step{"04"};
inline constexpr Status end_before_start{"05"};
inline constexpr Status interval_not_numeric{"06"};
inline constexpr Status count_not_numeric{"07"};
}  // namespace scan

/// SS and CR.
namespace setting {
inline constexpr Status not_numeric{"01"};
inline constexpr Status not_offered{"02"};  ///< the model does not have this value
inline constexpr Status unchanged{"03"};    ///< it is the present value
inline constexpr Status fixed{"04"};        ///< the model has one value only
}  // namespace setting

/// HS.
namespace sensitivity {
inline constexpr Status neither_on_nor_off{"01"};
inline constexpr Status unchanged{"02"};
inline constexpr Status fixed{"03"};
}  // namespace sensitivity

/// DB.
namespace rehearsal {
inline constexpr Status unknown{"01"};
inline constexpr Status under_way{"02"};
inline constexpr Status nothing_to_end{"03"};
inline constexpr Status not_on_this_model{"04"};
inline constexpr Status in_real_trouble{"05"};
}  // namespace rehearsal

inline constexpr Status no_laser{"01"};      ///< BM: the laser is out of order
inline constexpr Status already_on{"02"};    ///< BM
inline constexpr Status ask_again{"01"};     ///< RB: reboots when asked again within a second
inline constexpr Status no_such_mode{"01"};  ///< TM with another digit than 0, 1 and 2
inline constexpr Status already_in{"02"};    ///< TM0: in adjust mode
inline constexpr Status not_in{"03"};        ///< TM2: in adjust mode
inline constexpr Status no_address{"01"};    ///< $IP

}  // namespace status
}  // namespace scipd::protocol
