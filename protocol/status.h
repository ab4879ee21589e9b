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

/// The generic ones. What a number between 01 and 07 means depends on the command: see where it is
/// returned. Three of the specification are never sent, as nothing here leads to them:
/// 0A, it cannot make the data to be sent: it always can.
/// 0B, buffers full or a command repeated too fast: no recording shows it, drivers repeat theirs
/// and
///     take it for a failure; so all requests are answered in order, and a shell that is full
///     waits.
/// 0I, waiting for new firmware: that takes none.
namespace status {
inline constexpr Status ok{"00"};
inline constexpr Status scan_follows{"99"};
inline constexpr Status denied{
    "10"};  ///< not in the present state; to GD and its kin on old models: laser off
/// In the place of 99: the stream pauses to verify an error, goes on, ends for good (old models).
inline constexpr Status verifying{"21"};
inline constexpr Status broken{"50"};
inline constexpr Status resumed{"98"};
inline constexpr Status too_short{"0C"};
inline constexpr Status too_long{"0D"};
inline constexpr Status undefined{"0E"};
inline constexpr Status unsupported{"0F"};
inline constexpr Status string_too_long{"0G"};
inline constexpr Status string_illegal{"0H"};
inline constexpr Status abnormal{"0L"};
inline constexpr Status unstable{"0M"};  ///< of a scan: this one is left out
}  // namespace status

}  // namespace scipd::protocol
