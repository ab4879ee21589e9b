// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Hears on a serial line that a driver has a scanner change the rate: SS of SCIP 2.0, S of 1.1.
// Once the scanner has agreed, in full, it goes on at the other rate. One thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "protocol/line_reader.h"

namespace scipd::tools {

class RateChange {
  public:
    void asks(std::string_view bytes);
    /// The rate that holds behind these bytes, in bits per second; nothing: as before.
    [[nodiscard]] std::optional<int> answers(std::string_view bytes);
    /// Another driver is there.
    void forget() { *this = {}; }

  private:
    /// A line of the scanner, without its end.
    [[nodiscard]] std::optional<int> take(const std::string& line);

    protocol::LineReader reader_;
    std::string line_;     ///< what has come of one of the scanner's
    std::string request_;  ///< the latest that asks for a rate; empty: none
    int rate_ = 0;         ///< in it
    enum class Next { echo, status, end } next_ = Next::echo;
};

}  // namespace scipd::tools
