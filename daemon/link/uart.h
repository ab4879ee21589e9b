// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a serial line's receiver makes of bytes when it does not run at the rate of the sender. A
// byte is 8N1, on a line that is high while nothing is sent. The receiver looks for the falling
// edge of a start bit, and samples each bit in what it takes for the bit's middle:
//
//   ‾‾‾‾\___/ 0 \ 1 \ 2 \ 3 \ 4 \ 5 \ 6 \ 7 /‾‾‾    sent, least significant bit first
//         ^       ^       ^       ^       ^         sampled at half the rate
#pragma once

#include <string>
#include <string_view>

namespace scipd::daemon {

/// The bytes are sent one right after the other; the line rests before the first and after the
/// last. Rates are in bits per second, above 0. Two ends whose rates differ by less than about 5 %
/// understand each other.
[[nodiscard]] std::string heard(std::string_view sent, int sent_at, int read_at);
/// As a scanner takes it, which passes over bytes that no request can have where the rates differ.
[[nodiscard]] std::string heard_by_scanner(std::string_view sent, int sent_at, int read_at);

}  // namespace scipd::daemon
