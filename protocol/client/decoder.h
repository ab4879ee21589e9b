// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Cuts the bytes of a scanner into messages and checks every sum. It is strict: a message that
// differs from the specification carries a Damage, and decoding goes on with the next one. It never
// holds more than max_message characters. One thread.
//
//   echo LF  status sum LF  line sum LF ...  LF
//                                            the empty line ends the message
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/client/message.h"

namespace scipd::protocol::client {

class Decoder {
  public:
    /// The longest real line is a FIRM of SCIP 1.1 with about 70 characters.
    static constexpr std::size_t max_line = 128;
    /// A scan of 2881 steps with three echoes and intensities takes 58 kB.
    static constexpr std::size_t max_message = 128 * 1024;

    /// Takes bytes off the front of `bytes` until a message is complete. Returns nothing if it took
    /// all of them and needs more. It skips empty lines between messages.
    [[nodiscard]] std::optional<Message> next(std::string_view& bytes);

    /// Forgets an incomplete message.
    void reset() { *this = {}; }

  private:
    void take_line();
    void take_status();
    void take_data();
    void damaged(Damage::Kind kind);
    [[nodiscard]] Message finish();

    Message message_;
    std::string line_;        ///< the part that has come so far
    std::size_t number_ = 1;  ///< of that line
    std::size_t size_ = 0;    ///< characters in message_
};

}  // namespace scipd::protocol::client
