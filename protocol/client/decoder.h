// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Cuts the bytes of a scanner into messages and checks every sum. Strict: a message that is not
// exactly as the specification has it says so, and decoding goes on with the next. Holds no more
// than max_message characters whatever comes. One thread.
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
    /// The longest real line is a FIRM of SCIP 1.1 with some 70 characters.
    static constexpr std::size_t max_line = 128;
    /// Three echoes with intensity of 2881 steps take 58 kB.
    static constexpr std::size_t max_message = 128 * 1024;

    /// Takes bytes off the front of `bytes` until a message is complete; nothing: all were taken
    /// and more are needed. Empty lines between messages are passed over.
    [[nodiscard]] std::optional<Message> next(std::string_view& bytes);

    /// Forgets the message that has begun.
    void reset() { *this = {}; }

  private:
    void take_line();
    void take_status();
    void take_data();
    void damaged(Damage::Kind kind);
    [[nodiscard]] Message finish();

    Message message_;
    std::string line_;        ///< of what has come so far
    std::size_t number_ = 1;  ///< of that line
    std::size_t size_ = 0;    ///< characters in message_
};

}  // namespace scipd::protocol::client
