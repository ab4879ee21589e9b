// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Puts one message for a client together: echo, status, lines with their sums, an empty line. Lines
// end in LF only.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "protocol/status.h"

namespace scipd::protocol {

class Reply {
  public:
    Reply(std::string_view echo, Status status);

    /// TEXT and its sum.
    Reply& line(std::string_view text);
    /// KEY:VALUE;SUM, as in VV, PP and II. The sum is that of KEY:VALUE without the semicolon, as
    /// in all recordings.
    Reply& entry(std::string_view key, std::string_view value);
    Reply& entry(std::string_view key, int value);
    Reply& data(std::span<const std::uint32_t> values, int width);
    Reply& data(std::string_view characters);

    /// The whole message.
    [[nodiscard]] std::string finish();

  private:
    std::string text_;
};

}  // namespace scipd::protocol
